// What the analysis of a recording needs to know; the meaning of each entry is in settings/paper.toml.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/severity.hpp"

namespace lacuna {

struct Settings {
  double sampling_rate, duration;    // Hz, s
  std::vector<std::string> currents; // column names
  std::string angle;                 // column name, empty: no speed feature
  double section, overlap;           // of the record, of a section
  enum class Padding { record, section, none } padding;
  double peak_above, peak_threshold; // Hz, of the largest line
  double speed_after;                // s
  std::vector<Band> bands;

  /// From the text of a settings file; throws Error naming the entry that is missing or impossible.
  static Settings parse(std::string_view toml);

  std::size_t samples() const;
  std::size_t padded_length(std::size_t section_length) const;
};

} // namespace lacuna
