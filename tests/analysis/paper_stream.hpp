// The paper's actuator as the on-board chain sees it: its configuration, and rows of a simulated test.
#pragma once

#include <array>
#include <stdexcept>
#include <vector>

#include "lacuna/chain.hpp"
#include "lacuna/onboard/monitor.hpp"
#include "paper.hpp"
#include "reference_actuator.h"

inline lacuna::Configuration configuration_of(const lacuna::Chain &chain) {
  const auto &s = chain.settings();
  return {s.currents.size(), s.samples(),  chain.sections().length(), chain.sections().hop(), chain.spectrum().padded(),
          s.sampling_rate,   s.peak_above, s.peak_threshold,          s.speed_after};
}

/// Rows at 100 kHz: three currents, speed and angle. Throws std::runtime_error where the simulation fails.
inline std::vector<std::array<double, 5>> simulated(double zeta, int rows) {
  reference_parameters parameters = reference_defaults();
  parameters.zeta = zeta;
  std::vector<std::array<double, 5>> out(static_cast<std::size_t>(rows));
  if (reference_simulate(&parameters, 1e-5, rows, reinterpret_cast<double(*)[5]>(out.data())) <= 0)
    throw std::runtime_error("the reference actuator cannot be simulated");
  return out;
}
