#include "lacuna/chain.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "lacuna/error.hpp"

namespace lacuna {

namespace {

const Settings &checked(const Settings &settings) {
  settings.check();
  return settings;
}

} // namespace

Chain::Chain(const Settings &settings)
    : settings_(checked(settings)), sections_(settings.samples(), settings.section, settings.overlap),
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

PeakRule Chain::peak_rule() const {
  // A line of the unpadded section: half the main lobe of the Hann window.
  const double reach = static_cast<double>(spectrum_.padded()) / static_cast<double>(sections_.length());
  return {resolution_hz(), settings_.peak_above, settings_.peak_threshold, reach};
}

Eigen::ArrayXd Chain::peak_hold(std::span<const double> record, RealTransform::Buffers &work) const {
  PeakHold hold(spectrum_.lines());
  Eigen::ArrayXd squared;
  for (std::size_t k = 0; k < sections_.count(); ++k) {
    spectrum_.squared_magnitude(record.subspan(sections_.start(k), sections_.length()), work, squared);
    hold.add(squared);
  }
  return spectrum_.amplitude(hold.value());
}

Features Chain::analyse(const std::vector<std::span<const double>> &currents, std::span<const double> angle) const {
  if (currents.size() != settings_.currents.size())
    throw Error(std::to_string(currents.size()) + " currents given where the settings name " +
                std::to_string(settings_.currents.size()));
  Features features{{}, {}, 0, {0, std::numeric_limits<double>::quiet_NaN()}};
  RealTransform::Buffers work = spectrum_.buffers();
  for (std::size_t c = 0; c < currents.size(); ++c) {
    require_record(currents[c], settings_.currents[c]);
    features.held.push_back(peak_hold(currents[c], work));
    const Eigen::ArrayXd &held = features.held.back();
    const std::span<const double> lines(held.data(), static_cast<std::size_t>(held.size()));
    features.channels.push_back(channel_features(rms(currents[c]), lines, peak_rule()));
    features.rms_mean += features.channels.back().rms / static_cast<double>(currents.size());
  }
  if (!angle.empty()) {
    require_record(angle, settings_.angle);
    features.speed = mean_speed(angle, 1 / settings_.sampling_rate, settings_.speed_after);
  }
  return features;
}

} // namespace lacuna
