// The paper's settings, as analysis/settings/paper.toml has them.
#pragma once

#include <array>
#include <utility>

#include "lacuna/settings.hpp"

inline lacuna::Settings paper_settings() {
  return {100000.0,
          1.0,
          {"filter[1].y", "filter[2].y", "filter[3].y"},
          "rotor.phi",
          0.25,
          0.67,
          lacuna::Settings::Padding::record,
          5.0,
          0.1,
          0.3};
}

/// Severities at the ends of the four bands.
inline constexpr std::array<std::pair<double, double>, 4> paper_bands{
    {{0.0, 0.10}, {0.11, 0.26}, {0.27, 0.33}, {0.34, 0.50}}};
