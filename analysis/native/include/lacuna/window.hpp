// The Hann window of the paper's eq. (6): w[n] = (1 - cos(2 pi n / (N - 1))) / 2, zero at both ends.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace lacuna {

class HannWindow {
public:
  /// Throws Error for fewer than three samples, where the window would be zero everywhere.
  explicit HannWindow(std::size_t length);

  const Eigen::ArrayXd &values() const { return values_; }
  std::size_t length() const { return static_cast<std::size_t>(values_.size()); }
  /// Sum of w: the gain that a constant or a tone on a line sees.
  double sum() const { return sum_; }
  /// Sum of w^2: the gain that energy sees.
  double energy() const { return energy_; }

private:
  Eigen::ArrayXd values_;
  double sum_, energy_;
};

} // namespace lacuna
