// The numbers taken from a record and from its peak-hold spectrum.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

namespace lacuna {

/// Root mean square, eq. (7).
double rms(std::span<const double> x);

/// The first local maximum above `above_hz` that exceeds `threshold` times the largest line of all.
/// Not always the largest line: a second harmonic, or the direct component, may be larger.
std::optional<std::size_t> first_peak(const Eigen::ArrayXd &amplitude, double resolution_hz, double above_hz,
                                      double threshold);

struct MeanSpeed {
  int turns;    ///< whole turns of the rotor that it was taken over; 0: none was completed
  double value; ///< rad/s, NaN without a whole turn
};

/// Mean speed over the whole turns that follow the first sample later than `after` seconds: 2 pi turns over the time
/// they take, which is the time average of the speed. `angle` (rad) is not wrapped, sampled every `period` seconds.
MeanSpeed mean_speed(std::span<const double> angle, double period, double after);

} // namespace lacuna
