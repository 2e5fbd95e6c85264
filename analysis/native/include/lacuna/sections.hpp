// How a record is cut into overlapping time sections.
#pragma once

#include <cstddef>

namespace lacuna {

class Sections {
public:
  /// Cut a record of `samples` into sections of `share` of it, each overlapping the one before by `overlap` of a
  /// section. Only whole sections count. Throws Error where no section fits or the hop is zero.
  Sections(std::size_t samples, double share, double overlap);

  std::size_t count() const { return count_; }
  std::size_t length() const { return length_; }
  std::size_t hop() const { return hop_; }
  std::size_t start(std::size_t section) const { return section * hop_; }

private:
  std::size_t length_, hop_, count_;
};

} // namespace lacuna
