// The map as a machine needs it to estimate a severity: one compact file with a checksum, and the estimate itself.
// Standard library only; reading allocates, estimating does not.
//
// File, little-endian, no padding:
//   "LACUNAM2"
//   uint32  channels, severities m, conditions, bands, samples, section, hop, padded
//   double  sampling_rate, peak_above, peak_threshold, speed_after, misfit_limit
//   double  severity[m], rms_mean[m]
//   conditions x { double signature[m][n], whitening[m][n(n+1)/2], log_determinant[m] }
//   bands x { char name[16]; double first, last }
//   uint32  CRC-32 (IEEE 802.3) of all that precedes it
// n = signature_size(channels). whitening is the inverse W of the Cholesky factor of the signature's covariance C, row
// by row: |W d|^2 = d' C^-1 d. A condition is a level of the nuisance that moves a signature most, dry friction for
// instance; all are equally likely.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "lacuna/features.hpp"
#include "lacuna/signature.hpp"

namespace lacuna {

constexpr std::size_t max_channels = 6;

/// How a record is analysed, in samples.
struct Configuration {
  std::size_t channels, samples, section, hop, padded;
  double sampling_rate; // Hz
  double peak_above, peak_threshold;
  double speed_after; // s
};

struct Estimate {
  double severity;  ///< most likely, between the first and the last of the map
  double low, high; ///< 95 % interval, within the map
  double misfit;    ///< least squared distance to the map, in standard deviations: chi-squared if the map is right
  double paper;     ///< severity by the paper's method: the mean RMS alone, read back on the map
  std::size_t band; ///< of `severity`; in a gap, the nearer one
  bool covered;     ///< misfit is within the limit: the map can explain this record at some severity
};

class SeverityTable {
public:
  struct Band {
    char name[16];
    double first, last;
  };

  /// Throws std::runtime_error where the bytes are not a complete, unharmed and sensible table.
  explicit SeverityTable(std::span<const std::byte> file);

  const Configuration &configuration() const noexcept { return configuration_; }
  const std::vector<Band> &bands() const noexcept { return bands_; }

  /// `signature` [signature_size]; `rms_mean` in A.
  Estimate estimate(std::span<const double> signature, double rms_mean) const noexcept;

private:
  struct Condition {
    std::vector<double> signature, whitening, log_determinant;
  };
  struct Reading { // of one condition
    double severity, deviation, misfit, cost;
  };

  static double distance(const Condition &condition, std::size_t row, std::span<const double> signature) noexcept;
  Reading read(const Condition &condition, std::span<const double> signature) const noexcept;
  double by_mean_rms(double rms_mean) const noexcept;
  std::size_t band_of(double severity) const noexcept;
  void check() const;

  Configuration configuration_{};
  double misfit_limit_ = 0;
  std::vector<double> severity_, rms_mean_;
  std::vector<Condition> conditions_;
  std::vector<Band> bands_;
};

} // namespace lacuna
