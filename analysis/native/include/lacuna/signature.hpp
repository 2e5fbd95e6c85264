// The vector of features that a severity is estimated from. Standard library only.
//
// For each channel: ln(rms), ln(h1), h0/h1, h2/h1, h3/h1, with h the peak-hold amplitudes of direct component,
// fundamental and harmonics; then ln(mean frequency of the fundamental). Logarithms make a gain error a shift; the
// ratios do not see gain at all, and a symmetric motor has none of them, whatever its friction, supply or temperature.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "lacuna/features.hpp"

namespace lacuna {

constexpr std::size_t signature_per_channel = 5;

constexpr std::size_t signature_size(std::size_t channels) {
  return signature_per_channel * channels + 1;
}

/// Fills `out` [signature_size]. False, and `out` unspecified, where a channel has no first peak.
inline bool signature(std::span<const ChannelFeatures> channels, std::span<double> out) noexcept {
  double frequency = 0;
  std::size_t at = 0;
  for (const ChannelFeatures &channel : channels) {
    if (channel.peak_bin < 0) return false;
    const auto &h = channel.harmonic;
    for (const double value : {std::log(channel.rms), std::log(h[1]), h[0] / h[1], h[2] / h[1], h[3] / h[1]})
      out[at++] = value;
    frequency += channel.frequency / static_cast<double>(channels.size());
  }
  out[at] = std::log(frequency);
  return true;
}

} // namespace lacuna
