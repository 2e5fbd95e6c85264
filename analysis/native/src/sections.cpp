#include "lacuna/sections.hpp"

#include <cmath>
#include <string>

#include "lacuna/error.hpp"

namespace lacuna {

Sections::Sections(std::size_t samples, double share, double overlap) {
  if (!(share > 0 && share <= 1)) throw Error("spectrum.section must be above 0 and at most 1");
  if (!(overlap >= 0 && overlap < 1)) throw Error("spectrum.overlap must be at least 0 and below 1");
  length_ = static_cast<std::size_t>(std::llround(share * static_cast<double>(samples)));
  hop_ = static_cast<std::size_t>(std::llround((1 - overlap) * static_cast<double>(length_)));
  if (length_ < 3 || hop_ == 0)
    throw Error("a record of " + std::to_string(samples) + " samples is too short to be cut into sections");
  count_ = 1 + (samples - length_) / hop_;
}

} // namespace lacuna
