// Severity bands: which operating interval a severity lies in, and how far the mean RMS rises over each.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lacuna {

struct Band {
  std::string name, mode;
  double first, last; ///< severities, both included
};

class SeverityBands {
public:
  /// In rising order, not overlapping; throws Error otherwise. Gaps between them are allowed, the paper has some.
  explicit SeverityBands(std::vector<Band> bands);

  const std::vector<Band> &bands() const { return bands_; }
  /// The band of a severity; in a gap the nearer one (the published edges are whole percents), beyond the ends the
  /// first or last.
  const Band &of(double severity) const;
  /// Rise of a quantity over `band`, from its values at rising severities (linear between them).
  static double rise(const Band &band, std::span<const double> severity, std::span<const double> value);

private:
  std::vector<Band> bands_;
};

/// y(x) of a table of rising x, linear between its rows, constant outside.
double interpolate(std::span<const double> x, std::span<const double> y, double at);

} // namespace lacuna
