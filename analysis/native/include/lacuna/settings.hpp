// What the analysis of a recording needs to know; the meaning of each entry is in settings/paper.toml.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna {

struct Settings {
  double sampling_rate, duration;    // Hz, s
  std::vector<std::string> currents; // names, for messages
  std::string angle;                 // its name
  double section, overlap;           // of the record, of a section
  enum class Padding { none, section, record } padding;
  double peak_above, peak_threshold; // Hz, of the largest line
  double speed_after;                // s

  /// Throws Error naming the entry that is impossible.
  void check() const;

  std::size_t samples() const;
  std::size_t padded_length(std::size_t section_length) const;
};

} // namespace lacuna
