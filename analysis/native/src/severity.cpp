#include "lacuna/severity.hpp"

#include <algorithm>
#include <utility>

#include "lacuna/error.hpp"

namespace lacuna {

SeverityBands::SeverityBands(std::vector<Band> bands) : bands_(std::move(bands)) {
  if (bands_.empty()) throw Error("at least one severity band is needed");
  for (std::size_t k = 0; k < bands_.size(); ++k) {
    if (!(bands_[k].first <= bands_[k].last)) throw Error("band " + bands_[k].name + ": first is above last");
    if (k > 0 && !(bands_[k - 1].last < bands_[k].first))
      throw Error("band " + bands_[k].name + " does not begin above the end of " + bands_[k - 1].name);
  }
}

const Band &SeverityBands::of(double severity) const {
  std::size_t b = 0;
  while (b + 1 < bands_.size() && severity > 0.5 * (bands_[b].last + bands_[b + 1].first))
    ++b;
  return bands_[b];
}

double SeverityBands::rise(const Band &band, std::span<const double> severity, std::span<const double> value) {
  return interpolate(severity, value, band.last) - interpolate(severity, value, band.first);
}

double interpolate(std::span<const double> x, std::span<const double> y, double at) {
  if (x.empty() || x.size() != y.size()) throw Error("a table needs as many values as severities, and at least one");
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto k = static_cast<std::size_t>(above - x.begin());
  return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

} // namespace lacuna
