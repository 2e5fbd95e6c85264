// The numbers taken from a record and from its peak-hold spectrum. Standard library only: the on-board chain uses the
// same rules.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace lacuna {

/// Root mean square, eq. (7).
double rms(std::span<const double> x);

/// The first local maximum above `above_hz` that exceeds `threshold` times the largest line of all.
/// Not always the largest line: a second harmonic, or the direct component, may be larger.
std::optional<std::size_t> first_peak(std::span<const double> amplitude, double resolution_hz, double above_hz,
                                      double threshold);

/// The place of a local maximum between the lines, in lines: vertex of the parabola through the logarithms of
/// three lines, nearly exact for a Hann window. `peak` is neither the first nor the last line.
double between_lines(std::span<const double> amplitude, std::size_t peak);

/// Direct component, fundamental, second and third harmonic of a peak-hold spectrum.
constexpr std::size_t harmonics = 4;

/// Largest amplitude within `reach` lines of 0, 1, 2 and 3 times `fundamental` (in lines); 0 beyond the spectrum.
std::array<double, harmonics> harmonic_amplitudes(std::span<const double> amplitude, double fundamental, double reach);

/// How the first peak of a peak-hold spectrum is found, and how far its harmonics are looked for.
struct PeakRule {
  double resolution_hz; ///< from line to line
  double above_hz, threshold;
  double reach; ///< lines on either side of a multiple of the fundamental
};

struct ChannelFeatures {
  double rms;                             ///< of the whole record
  std::ptrdiff_t peak_bin;                ///< first peak of the peak-hold spectrum; -1: there is none
  double peak_hz;                         ///< its frequency; NaN without a peak
  double peak_amplitude;                  ///< its amplitude; NaN without a peak
  double frequency;                       ///< Hz, of the fundamental, between the lines; NaN without a peak
  std::array<double, harmonics> harmonic; ///< amplitudes of 0, 1, 2, 3 times the fundamental; NaN without a peak
};

/// Everything that is read off a channel's peak-hold amplitude spectrum.
ChannelFeatures channel_features(double rms, std::span<const double> held, const PeakRule &rule);

struct MeanSpeed {
  int turns;    ///< whole turns of the rotor that it was taken over; 0: none was completed
  double value; ///< rad/s, NaN without a whole turn
};

/// Mean speed over whole turns: 2 pi turns over the time they take, which is the time average of the speed.
/// The turns are counted from the first angle, in the direction of the first one that is completed.
class WholeTurns {
public:
  /// The next angle, rad, not wrapped.
  void add(double angle);
  /// `period` seconds from one angle to the next.
  MeanSpeed mean_speed(double period) const;

private:
  std::size_t samples_ = 0;
  int turns_ = 0;                 // signed
  double first_ = 0, travel_ = 0; // rad
  double duration_ = 0;           // of the turns, in samples
  bool absurd_ = false;           // an angle was given that no shaft can have: more turns than can be counted
};

/// Mean speed over the whole turns that follow the first sample later than `after` seconds.
MeanSpeed mean_speed(std::span<const double> angle, double period, double after);

/// The first sample later than `after` seconds.
std::size_t first_sample_after(double after, double period);

} // namespace lacuna
