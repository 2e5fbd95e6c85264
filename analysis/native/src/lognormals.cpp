// The distribution of the remaining use of a forecast: a sum of lognormals (analysis/prognosis/filter/crossing.py).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lacuna_analysis.h"

namespace {

/// The normal distribution by its Taylor polynomial of second order about the nearest of a table's points: the third
/// order, h^3 max|phi''|/6 with h = 1/128 from a point, is below 4e-8.
class Normal {
public:
  Normal() {
    for (std::size_t k = 0; k < size; ++k) {
      const double z = (static_cast<double>(k) - half) / per_unit;
      table_[k] = {0.5 * std::erfc(-z / std::sqrt(2.0)), std::exp(-0.5 * z * z) / std::sqrt(2 * 3.14159265358979324)};
    }
  }

  double operator()(double z) const {
    if (!(z > -beyond)) return 0;
    if (z >= beyond) return 1;
    const auto k = static_cast<std::size_t>(z * per_unit + nearest);
    const double at = (static_cast<double>(k) - half) / per_unit, d = z - at;
    return table_[k].below + table_[k].density * d * (1 - 0.5 * at * d);
  }

private:
  static constexpr double per_unit = 64, beyond = 8, half = beyond * per_unit;
  static constexpr double nearest = half + 0.5; // rounds to the nearest point where it is cut off
  static constexpr std::size_t size = static_cast<std::size_t>(2 * half) + 1;
  struct Point {
    double below, density;
  };
  std::array<Point, size> table_;
};

} // namespace

void lacuna_lognormals_reached(const double *mean, const double *sd, const double *weight, size_t histories,
                               size_t lognormals, const double *log_use, size_t points, double *reached) {
  static const Normal normal;
  for (std::size_t b = 0; b < histories; ++b) {
    double *const found = reached + b * points;
    std::fill(found, found + points, 0.0);
    for (std::size_t p = b * lognormals; p < (b + 1) * lognormals; ++p) {
      if (!(weight[p] > 0)) continue;
      const double each = 1 / sd[p];
      for (std::size_t k = 0; k < points; ++k)
        found[k] += weight[p] * (std::isinf(mean[p]) ? 1 : normal((log_use[b * points + k] - mean[p]) * each));
    }
  }
}
