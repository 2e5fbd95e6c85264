#include "lacuna/window.hpp"

#include <cmath>
#include <numbers>

#include "lacuna/error.hpp"

namespace lacuna {

HannWindow::HannWindow(std::size_t length) : values_(static_cast<Eigen::Index>(length)) {
  if (length < 3) throw Error("a Hann window needs at least three samples");
  const double step = 2 * std::numbers::pi / static_cast<double>(length - 1);
  for (Eigen::Index n = 0; n < values_.size(); ++n)
    values_[n] = 0.5 * (1 - std::cos(step * static_cast<double>(n)));
  sum_ = values_.sum();
  energy_ = values_.square().sum();
}

} // namespace lacuna
