// The spectral chain on a stream: samples in one by one, features of every record, on memory that is fixed at the
// start.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lacuna/features.hpp"
#include "lacuna/onboard/fft.hpp"
#include "lacuna/severity_table.hpp"

namespace lacuna::onboard {

struct RecordFeatures {
  std::array<ChannelFeatures, max_channels> channels; ///< the first `Configuration::channels` of them
  double rms_mean;
  MeanSpeed speed; ///< no turns where no angle was given
  bool valid;      ///< false: a sample, or a feature, is not a finite number, and nothing else here counts
};

class Monitor {
public:
  /// Throws std::invalid_argument where the configuration is impossible. The only place where memory is allocated.
  explicit Monitor(const Configuration &configuration);

  /// One sample of each channel (A), and the rotor's angle (rad, not wrapped; NaN: not measured). True when it
  /// completed a record: then features() are of that record, until the next one is complete.
  bool push(std::span<const double> currents, double angle) noexcept;
  const RecordFeatures &features() const noexcept { return features_; }
  const Configuration &configuration() const noexcept { return setup_; }

private:
  void analyse_section(std::size_t channel) noexcept;
  void finish_record() noexcept;
  void start_record() noexcept;

  struct Channel {
    std::vector<double> ring, held; // the last section of samples; |F|^2 by slot
    double sum_of_squares = 0;
  };

  Configuration setup_;
  RealFft fft_;
  std::vector<double> window_;
  double window_sum_ = 0;
  std::vector<Channel> channels_;
  std::size_t taken_ = 0; // samples of the present record
  bool finite_ = true, has_angle_ = true;
  WholeTurns turns_;
  RecordFeatures features_{};
};

} // namespace lacuna::onboard
