#include "lacuna/features.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna {

double rms(std::span<const double> x) {
  const Eigen::Map<const Eigen::ArrayXd> samples(x.data(), static_cast<Eigen::Index>(x.size()));
  return std::sqrt(samples.square().mean());
}

std::optional<std::size_t> first_peak(const Eigen::ArrayXd &amplitude, double resolution_hz, double above_hz,
                                      double threshold) {
  const double floor = threshold * amplitude.maxCoeff();
  for (Eigen::Index k = 1; k + 1 < amplitude.size(); ++k) {
    const bool summit = amplitude[k] > amplitude[k - 1] && amplitude[k] >= amplitude[k + 1];
    if (summit && static_cast<double>(k) * resolution_hz > above_hz && amplitude[k] > floor)
      return static_cast<std::size_t>(k);
  }
  return std::nullopt;
}

MeanSpeed mean_speed(std::span<const double> angle, double period, double after) {
  const MeanSpeed none{0, std::numeric_limits<double>::quiet_NaN()};
  const auto first = static_cast<std::size_t>(std::floor(after / period + 1e-9)) + 1;
  if (first >= angle.size()) return none;
  const double turn = 2 * std::numbers::pi, travel = angle.back() - angle[first];
  const int turns = static_cast<int>(std::floor(std::abs(travel) / turn));
  if (turns == 0) return none;
  const double goal = turns * turn, sign = travel < 0 ? -1 : 1;
  std::size_t k = first;
  while (k + 2 < angle.size() && sign * (angle[k + 1] - angle[first]) < goal)
    ++k;
  const double before = sign * (angle[k] - angle[first]), past = sign * (angle[k + 1] - angle[first]);
  const double duration = period * (static_cast<double>(k - first) + (goal - before) / (past - before));
  return {turns, sign * goal / duration};
}

} // namespace lacuna
