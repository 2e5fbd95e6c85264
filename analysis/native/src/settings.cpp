#include "lacuna/settings.hpp"

#include <cmath>

#include "lacuna/error.hpp"
#include "lacuna/toml.hpp"
#include "lacuna/transform.hpp"

namespace lacuna {

namespace {

double positive(const toml::Table &table, const std::string &name, const std::string &key) {
  const double value = table.number(key);
  if (!(value > 0 && std::isfinite(value))) throw Error("settings: " + name + "." + key + " must be above zero");
  return value;
}

double share(const toml::Table &table, const std::string &name, const std::string &key) {
  const double value = table.number(key);
  if (!(value >= 0 && value <= 1)) throw Error("settings: " + name + "." + key + " must be between 0 and 1");
  return value;
}

Settings::Padding parse_padding(const std::string &text) {
  if (text == "record") return Settings::Padding::record;
  if (text == "section") return Settings::Padding::section;
  if (text == "none") return Settings::Padding::none;
  throw Error("settings: spectrum.padding must be \"record\", \"section\" or \"none\", not \"" + text + "\"");
}

std::vector<Band> parse_bands(const toml::Document &document) {
  std::vector<Band> result;
  for (const toml::Table &table : document.tables("bands"))
    result.push_back({table.text("name"), table.text("mode"), table.number("first"), table.number("last")});
  return SeverityBands(result).bands();
}

} // namespace

Settings Settings::parse(std::string_view text) {
  const toml::Document document(text);
  const toml::Table &recording = document.table("recording"), &signals = document.table("signals"),
                    &spectrum = document.table("spectrum"), &peak = document.table("first_peak");
  Settings s{};
  s.sampling_rate = positive(recording, "recording", "sampling_rate");
  s.duration = positive(recording, "recording", "duration");
  if (s.sampling_rate * s.duration > 1e8) throw Error("settings: a record of more than 1e8 samples is not supported");
  s.currents = signals.texts("currents");
  if (s.currents.empty()) throw Error("settings: signals.currents must name at least one signal");
  if (signals.has("angle")) s.angle = signals.text("angle");
  s.section = share(spectrum, "spectrum", "section");
  s.overlap = share(spectrum, "spectrum", "overlap");
  s.padding = parse_padding(spectrum.text("padding"));
  s.peak_above = peak.number("above");
  s.peak_threshold = share(peak, "first_peak", "threshold");
  s.speed_after = s.angle.empty() ? 0 : document.table("speed").number("after");
  if (!(s.speed_after >= 0)) throw Error("settings: speed.after must not be negative");
  s.bands = parse_bands(document);
  return s;
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
