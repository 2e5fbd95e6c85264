#include "lacuna/severity_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace lacuna {

namespace {

constexpr std::size_t max_severities = 10000, max_bands = 16;
constexpr double normal_95 = 1.959964; // half width of a 95 % interval, in standard deviations

std::uint32_t crc32(std::span<const std::byte> bytes) {
  std::uint32_t crc = ~0U;
  for (const std::byte byte : bytes) {
    crc ^= static_cast<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit)
      crc = crc >> 1 ^ (crc & 1U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

/// Takes little-endian values off the front of a file, on machines of either byte order.
class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::span<const std::byte> take(std::size_t n) {
    if (n > rest_.size()) throw std::runtime_error("severity table: the file is truncated");
    const auto taken = rest_.first(n);
    rest_ = rest_.subspan(n);
    return taken;
  }

  template <typename Unsigned> Unsigned whole() {
    Unsigned value = 0;
    unsigned shift = 0;
    for (const std::byte byte : take(sizeof(Unsigned))) {
      value |= static_cast<Unsigned>(byte) << shift;
      shift += 8;
    }
    return value;
  }

  std::size_t count() { return whole<std::uint32_t>(); }

  double number() {
    const auto value = std::bit_cast<double>(whole<std::uint64_t>());
    if (!std::isfinite(value)) throw std::runtime_error("severity table: a number is not finite");
    return value;
  }

  std::vector<double> numbers(std::size_t n) {
    if (n > rest_.size() / sizeof(double)) throw std::runtime_error("severity table: the file is truncated");
    std::vector<double> values(n);
    for (double &value : values)
      value = number();
    return values;
  }

  bool at_end() const { return rest_.empty(); }

private:
  std::span<const std::byte> rest_;
};

} // namespace

SeverityTable::SeverityTable(std::span<const std::byte> file) {
  if (file.size() < 12) throw std::runtime_error("severity table: the file is truncated");
  Reader tail(file.last(4)), reader(file.first(file.size() - 4));
  if (std::memcmp(reader.take(8).data(), "LACUNAM1", 8) != 0)
    throw std::runtime_error("severity table: this is not a severity table, or one of another version");
  if (crc32(file.first(file.size() - 4)) != tail.whole<std::uint32_t>())
    throw std::runtime_error("severity table: the checksum does not match, the file is damaged");
  const std::size_t channels = reader.count(), rows = reader.count(), bands = reader.count();
  const std::size_t samples = reader.count(), section = reader.count(), hop = reader.count(), padded = reader.count();
  if (channels < 1 || channels > max_channels || rows < 3 || rows > max_severities || bands < 1 || bands > max_bands)
    throw std::runtime_error("severity table: impossible number of channels, severities or bands");
  const double rate = reader.number(), above = reader.number(), threshold = reader.number(), after = reader.number();
  configuration_ = {channels, samples, section, hop, padded, rate, above, threshold, after};
  misfit_limit_ = reader.number();
  const std::size_t n = signature_size(channels);
  severity_ = reader.numbers(rows);
  rms_mean_ = reader.numbers(rows);
  signature_ = reader.numbers(rows * n);
  whitening_ = reader.numbers(rows * n * (n + 1) / 2);
  log_determinant_ = reader.numbers(rows);
  for (std::size_t b = 0; b < bands; ++b) {
    Band band{};
    std::memcpy(band.name, reader.take(sizeof band.name).data(), sizeof band.name - 1);
    band.first = reader.number();
    band.last = reader.number();
    bands_.push_back(band);
  }
  if (!reader.at_end()) throw std::runtime_error("severity table: there is more in the file than there should be");
  check();
}

void SeverityTable::check() const {
  if (!std::is_sorted(severity_.begin(), severity_.end(), std::less_equal<>()))
    throw std::runtime_error("severity table: severities do not rise");
  const Configuration &c = configuration_;
  const bool sizes = c.section >= 3 && c.section <= c.samples && c.section <= c.padded && c.hop >= 1 &&
                     c.samples <= 100000000 && c.padded >= 16 && c.padded <= (1U << 28) &&
                     std::has_single_bit(c.padded);
  if (!sizes || !(c.sampling_rate > 0) || !(c.speed_after >= 0))
    throw std::runtime_error("severity table: impossible sampling or sections");
}

/// Squared distance of `signature` to a row of the map, in standard deviations.
double SeverityTable::distance(std::size_t row, std::span<const double> signature) const noexcept {
  const std::size_t n = signature.size();
  const double *mean = &signature_[row * n], *w = &whitening_[row * n * (n + 1) / 2];
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double component = 0;
    for (std::size_t j = 0; j <= i; ++j)
      component += *w++ * (signature[j] - mean[j]);
    sum += component * component;
  }
  return sum;
}

/// Minus twice the logarithm of the likelihood of a row's severity.
double SeverityTable::cost(std::size_t row, std::span<const double> signature) const noexcept {
  return distance(row, signature) + log_determinant_[row];
}

/// The most likely severity is the vertex of the parabola through the best row and its neighbours, the interval follows
/// from its curvature.
Estimate SeverityTable::estimate(std::span<const double> signature, double rms_mean) const noexcept {
  const std::size_t last = severity_.size() - 1;
  std::size_t best = 0;
  double lowest = cost(0, signature);
  for (std::size_t row = 1; row <= last; ++row)
    if (const double found = cost(row, signature); found < lowest) {
      lowest = found;
      best = row;
    }
  const std::size_t k = std::clamp<std::size_t>(best, 1, last - 1);
  const double left = severity_[k - 1] - severity_[k], right = severity_[k + 1] - severity_[k];
  const double slope_left = (cost(k - 1, signature) - cost(k, signature)) / left;
  const double slope_right = (cost(k + 1, signature) - cost(k, signature)) / right;
  const double curvature = (slope_right - slope_left) / (right - left); // of cost = c0 + slope x + curvature x^2
  const double slope = slope_left - curvature * left;
  const double first = severity_.front(), end = severity_.back();
  Estimate found{severity_[best], first, end, distance(best, signature), by_mean_rms(rms_mean), 0, false};
  if (curvature > 0) {
    const double half = normal_95 / std::sqrt(curvature);
    found.severity = std::clamp(severity_[k] - slope / (2 * curvature), first, end);
    found.low = std::max(first, found.severity - half);
    found.high = std::min(end, found.severity + half);
    const double x = found.severity - severity_[k];
    found.misfit = std::max(0.0, distance(k, signature) + (slope + curvature * x) * x);
  }
  found.band = band_of(found.severity);
  found.covered = found.misfit <= misfit_limit_;
  return found;
}

/// The largest severity whose mean RMS, made monotonous, does not exceed the measured one: near zero severity the
/// curve is flat and first falls a little.
double SeverityTable::by_mean_rms(double rms_mean) const noexcept {
  double floor = rms_mean_.front();
  if (rms_mean <= floor) return severity_.front();
  for (std::size_t k = 1; k < severity_.size(); ++k) {
    const double level = std::max(floor, rms_mean_[k]);
    if (rms_mean < level)
      return severity_[k - 1] + (severity_[k] - severity_[k - 1]) * (rms_mean - floor) / (level - floor);
    floor = level;
  }
  return severity_.back();
}

std::size_t SeverityTable::band_of(double severity) const noexcept {
  std::size_t b = 0;
  while (b + 1 < bands_.size() && severity > 0.5 * (bands_[b].last + bands_[b + 1].first))
    ++b;
  return b;
}

} // namespace lacuna
