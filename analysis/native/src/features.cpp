#include "lacuna/features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna {

double rms(std::span<const double> x) {
  double sum = 0;
  for (const double value : x)
    sum += value * value;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

std::optional<std::size_t> first_peak(std::span<const double> amplitude, double resolution_hz, double above_hz,
                                      double threshold) {
  const double floor = threshold * *std::max_element(amplitude.begin(), amplitude.end());
  for (std::size_t k = 1; k + 1 < amplitude.size(); ++k) {
    const bool summit = amplitude[k] > amplitude[k - 1] && amplitude[k] >= amplitude[k + 1];
    if (summit && static_cast<double>(k) * resolution_hz > above_hz && amplitude[k] > floor) return k;
  }
  return std::nullopt;
}

double between_lines(std::span<const double> amplitude, std::size_t peak) {
  const double left = std::log(amplitude[peak - 1]), top = std::log(amplitude[peak]),
               right = std::log(amplitude[peak + 1]), curvature = left - 2 * top + right;
  const double offset = curvature < 0 ? 0.5 * (left - right) / curvature : 0;
  return static_cast<double>(peak) + (std::isfinite(offset) ? std::clamp(offset, -0.5, 0.5) : 0);
}

std::array<double, harmonics> harmonic_amplitudes(std::span<const double> amplitude, double fundamental, double reach) {
  std::array<double, harmonics> found{};
  const auto last = static_cast<double>(amplitude.size() - 1);
  for (std::size_t h = 0; h < harmonics; ++h) {
    const double centre = static_cast<double>(h) * fundamental;
    const auto from = static_cast<std::size_t>(std::ceil(std::max(0.0, centre - reach)));
    const auto to = static_cast<std::size_t>(std::floor(std::min(last, centre + reach)));
    for (std::size_t k = from; k <= to; ++k)
      found[h] = std::max(found[h], amplitude[k]);
  }
  return found;
}

ChannelFeatures channel_features(double rms, std::span<const double> held, const PeakRule &rule) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ChannelFeatures features{rms, -1, nan, nan, nan, {nan, nan, nan, nan}};
  if (const auto peak = first_peak(held, rule.resolution_hz, rule.above_hz, rule.threshold)) {
    const double fundamental = between_lines(held, *peak);
    features.peak_bin = static_cast<std::ptrdiff_t>(*peak);
    features.peak_hz = static_cast<double>(*peak) * rule.resolution_hz;
    features.peak_amplitude = held[*peak];
    features.frequency = fundamental * rule.resolution_hz;
    features.harmonic = harmonic_amplitudes(held, fundamental, rule.reach);
  }
  return features;
}

void WholeTurns::add(double angle) {
  const double turn = 2 * std::numbers::pi;
  if (samples_ == 0) first_ = angle;
  const double travel = angle - first_;
  const int direction = turns_ == 0 ? (travel < 0 ? -1 : 1) : (turns_ < 0 ? -1 : 1);
  double passed = std::floor(direction * travel / turn); // whole turns, but for the rounding of the quotient
  if (!(std::abs(passed) < std::numeric_limits<int>::max())) {
    absurd_ = true;
    return;
  }
  if (direction * travel - turn * (passed + 1) >= 0) passed += 1;
  if (direction * travel - turn * passed < 0) passed -= 1;
  if (passed > std::abs(turns_)) {
    turns_ = direction * static_cast<int>(passed);
    duration_ = static_cast<double>(samples_) - (travel - turn * turns_) / (travel - travel_);
  }
  travel_ = travel;
  ++samples_;
}

MeanSpeed WholeTurns::mean_speed(double period) const {
  if (turns_ == 0 || absurd_) return {0, std::numeric_limits<double>::quiet_NaN()};
  return {std::abs(turns_), 2 * std::numbers::pi * turns_ / (period * duration_)};
}

std::size_t first_sample_after(double after, double period) {
  // A time that is a sample's own, but for rounding, is not later than that sample.
  const double last = std::floor(after / period + 1e-9);
  return last < 1e15 ? static_cast<std::size_t>(last) + 1 : std::numeric_limits<std::size_t>::max(); // never
}

MeanSpeed mean_speed(std::span<const double> angle, double period, double after) {
  WholeTurns turns;
  for (std::size_t k = first_sample_after(after, period); k < angle.size(); ++k)
    turns.add(angle[k]);
  return turns.mean_speed(period);
}

} // namespace lacuna
