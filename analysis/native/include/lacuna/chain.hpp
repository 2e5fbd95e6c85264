// The paper's "EMA Spectral Algorithm": from the sampled phase currents of one recording to its features.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lacuna/features.hpp"
#include "lacuna/sections.hpp"
#include "lacuna/settings.hpp"
#include "lacuna/spectrum.hpp"

namespace lacuna {

struct Features {
  std::vector<ChannelFeatures> channels;
  std::vector<Eigen::ArrayXd> held; ///< [channels][lines] peak-hold amplitude spectra
  double rms_mean;
  MeanSpeed speed;
};

/// Built once for its settings (window, plan); then any number of threads may analyse with it.
class Chain {
public:
  explicit Chain(const Settings &settings);

  const Settings &settings() const { return settings_; }
  const Sections &sections() const { return sections_; }
  const SectionSpectrum &spectrum() const { return spectrum_; }
  PeakRule peak_rule() const;
  double resolution_hz() const { return settings_.sampling_rate / static_cast<double>(spectrum_.padded()); }

  /// `currents` as many as in the settings, each a whole record; `angle` a whole record or empty (no speed).
  /// Throws Error where a record has another length or a value that is not finite, naming channel and time.
  Features analyse(const std::vector<std::span<const double>> &currents, std::span<const double> angle) const;

private:
  void require_record(std::span<const double> record, const std::string &name) const;
  Eigen::ArrayXd peak_hold(std::span<const double> record, RealTransform::Buffers &work) const;

  Settings settings_;
  Sections sections_;
  SectionSpectrum spectrum_;
};

} // namespace lacuna
