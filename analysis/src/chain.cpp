#include "lacuna/chain.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "lacuna/error.hpp"

namespace lacuna {

Chain::Chain(const Settings &settings)
    : settings_(settings), sections_(settings.samples(), settings.section, settings.overlap),
      spectrum_(HannWindow(sections_.length()), settings.padded_length(sections_.length())) {}

void Chain::require_record(std::span<const double> record, const std::string &name) const {
  if (record.size() != settings_.samples())
    throw Error(name + " has " + std::to_string(record.size()) + " samples where the settings ask for " +
                std::to_string(settings_.samples()));
  for (std::size_t k = 0; k < record.size(); ++k)
    if (!std::isfinite(record[k]))
      throw Error(name + " is not a finite number at " +
                  std::to_string(static_cast<double>(k) / settings_.sampling_rate) + " s");
}

ChannelFeatures Chain::analyse_channel(std::span<const double> record, RealTransform::Buffers &work) const {
  PeakHold hold(spectrum_.lines());
  Eigen::ArrayXd squared;
  for (std::size_t k = 0; k < sections_.count(); ++k) {
    spectrum_.squared_magnitude(record.subspan(sections_.start(k), sections_.length()), work, squared);
    hold.add(squared);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ChannelFeatures channel{rms(record), -1, nan, nan, spectrum_.amplitude(hold.value())};
  if (const auto peak = first_peak(channel.held, resolution_hz(), settings_.peak_above, settings_.peak_threshold)) {
    channel.peak_bin = static_cast<std::ptrdiff_t>(*peak);
    channel.peak_hz = static_cast<double>(*peak) * resolution_hz();
    channel.peak_amplitude = channel.held[channel.peak_bin];
  }
  return channel;
}

Features Chain::analyse(const std::vector<std::span<const double>> &currents, std::span<const double> angle) const {
  if (currents.size() != settings_.currents.size())
    throw Error(std::to_string(currents.size()) + " currents given where the settings name " +
                std::to_string(settings_.currents.size()));
  Features features{{}, 0, {0, std::numeric_limits<double>::quiet_NaN()}};
  RealTransform::Buffers work = spectrum_.buffers();
  for (std::size_t c = 0; c < currents.size(); ++c) {
    require_record(currents[c], settings_.currents[c]);
    features.channels.push_back(analyse_channel(currents[c], work));
    features.rms_mean += features.channels.back().rms / static_cast<double>(currents.size());
  }
  if (!angle.empty()) {
    require_record(angle, settings_.angle);
    features.speed = mean_speed(angle, 1 / settings_.sampling_rate, settings_.speed_after);
  }
  return features;
}

} // namespace lacuna
