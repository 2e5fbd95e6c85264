// The one exception of the analysis library: a recording, a setting or a file that cannot be used.
#pragma once

#include <stdexcept>

namespace lacuna {

class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace lacuna
