#include "lacuna/settings.hpp"

#include <cmath>

#include "lacuna/error.hpp"
#include "lacuna/transform.hpp"

namespace lacuna {

namespace {

void positive(double value, const std::string &entry) {
  if (!(value > 0 && std::isfinite(value))) throw Error("settings: " + entry + " must be above zero");
}

void share(double value, const std::string &entry) {
  if (!(value >= 0 && value <= 1)) throw Error("settings: " + entry + " must be between 0 and 1");
}

} // namespace

void Settings::check() const {
  positive(sampling_rate, "recording.sampling_rate");
  positive(duration, "recording.duration");
  if (sampling_rate * duration > 1e8) throw Error("settings: a record of more than 1e8 samples is not supported");
  if (currents.empty()) throw Error("settings: signals.currents must name at least one signal");
  share(section, "spectrum.section");
  share(overlap, "spectrum.overlap");
  if (!std::isfinite(peak_above)) throw Error("settings: first_peak.above must be a finite number");
  share(peak_threshold, "first_peak.threshold");
  if (!(speed_after >= 0)) throw Error("settings: speed.after must not be negative");
}

std::size_t Settings::samples() const {
  return static_cast<std::size_t>(std::llround(sampling_rate * duration));
}

std::size_t Settings::padded_length(std::size_t section_length) const {
  if (padding == Padding::record) return next_power_of_two(samples());
  if (padding == Padding::section) return next_power_of_two(section_length);
  return section_length + section_length % 2;
}

} // namespace lacuna
