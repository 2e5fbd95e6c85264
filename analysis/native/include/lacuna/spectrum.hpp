// Single-sided spectrum of one windowed, zero-padded time section.
//
// With F the DFT of the N points w[n] x[n] (zeros after the section), c = 2 inside and 1 at the first and the last
// line (their mirror image is themselves):
//
//   amplitude[k] = c |F[k]| / sum(w)            a tone on a line reads its peak value, a constant its value
//   power[k]     = c |F[k]|^2 / (N sum(w^2))    sum over k = sum (w x)^2 / sum w^2: Parseval, so energy is preserved
//
// The two differ by design: a window spreads a tone over several lines, so one number per line cannot be both.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "lacuna/transform.hpp"
#include "lacuna/window.hpp"

namespace lacuna {

class SectionSpectrum {
public:
  /// `padded` >= the window's length and even.
  SectionSpectrum(HannWindow window, std::size_t padded);

  const HannWindow &window() const { return window_; }
  std::size_t padded() const { return transform_.length(); }
  std::size_t lines() const { return transform_.lines(); }
  RealTransform::Buffers buffers() const { return RealTransform::Buffers(transform_); }

  /// |F[k]|^2 of `section` (as long as the window), into `out` [lines].
  void squared_magnitude(std::span<const double> section, RealTransform::Buffers &work, Eigen::ArrayXd &out) const;

  Eigen::ArrayXd amplitude(const Eigen::ArrayXd &squared_magnitude) const;
  Eigen::ArrayXd power(const Eigen::ArrayXd &squared_magnitude) const;

private:
  HannWindow window_;
  RealTransform transform_;
};

/// For each line the largest value of all spectra that were added: the paper's peak hold.
class PeakHold {
public:
  explicit PeakHold(std::size_t lines) : held_(Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(lines))) {}
  void add(const Eigen::ArrayXd &spectrum) { held_ = held_.max(spectrum); }
  const Eigen::ArrayXd &value() const { return held_; }

private:
  Eigen::ArrayXd held_;
};

} // namespace lacuna
