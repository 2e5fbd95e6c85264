#include "lacuna/severity_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace lacuna {

namespace {

constexpr std::size_t max_severities = 10000, max_bands = 16, max_conditions = 16;
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
  if (std::memcmp(reader.take(8).data(), "LACUNAM2", 8) != 0)
    throw std::runtime_error("severity table: this is not a severity table, or one of another version");
  if (crc32(file.first(file.size() - 4)) != tail.whole<std::uint32_t>())
    throw std::runtime_error("severity table: the checksum does not match, the file is damaged");
  const std::size_t channels = reader.count(), rows = reader.count(), conditions = reader.count(),
                    bands = reader.count();
  const std::size_t samples = reader.count(), section = reader.count(), hop = reader.count(), padded = reader.count();
  if (channels < 1 || channels > max_channels || rows < 3 || rows > max_severities || conditions < 1 ||
      conditions > max_conditions || bands < 1 || bands > max_bands)
    throw std::runtime_error("severity table: impossible number of channels, severities, conditions or bands");
  const double rate = reader.number(), above = reader.number(), threshold = reader.number(), after = reader.number();
  configuration_ = {channels, samples, section, hop, padded, rate, above, threshold, after};
  misfit_limit_ = reader.number();
  const std::size_t n = signature_size(channels);
  severity_ = reader.numbers(rows);
  rms_mean_ = reader.numbers(rows);
  for (std::size_t c = 0; c < conditions; ++c) {
    Condition condition;
    condition.signature = reader.numbers(rows * n);
    condition.whitening = reader.numbers(rows * n * (n + 1) / 2);
    condition.log_determinant = reader.numbers(rows);
    conditions_.push_back(std::move(condition));
  }
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
                     c.samples <= 100000000 && c.padded >= 16 && c.padded <= (1U << 24) &&
                     std::has_single_bit(c.padded);
  if (!sizes || !(c.sampling_rate > 0) || !(c.speed_after >= 0))
    throw std::runtime_error("severity table: impossible sampling or sections");
}

/// Squared distance of `signature` to a row of the map, in standard deviations.
double SeverityTable::distance(const Condition &condition, std::size_t row,
                               std::span<const double> signature) noexcept {
  const std::size_t n = signature.size();
  const double *mean = &condition.signature[row * n], *w = &condition.whitening[row * n * (n + 1) / 2];
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double component = 0;
    for (std::size_t j = 0; j <= i; ++j)
      component += *w++ * (signature[j] - mean[j]);
    sum += component * component;
  }
  return sum;
}

/// Generalised least squares over severity: the vertex of the parabola through the nearest row and its neighbours, and
/// its deviation from the curvature. Cost is minus twice the logarithm of the likelihood.
SeverityTable::Reading SeverityTable::read(const Condition &condition,
                                           std::span<const double> signature) const noexcept {
  const auto from = [&](std::size_t row) { return distance(condition, row, signature); };
  const std::size_t last = severity_.size() - 1;
  std::size_t best = 0;
  double lowest = from(0);
  for (std::size_t row = 1; row <= last; ++row)
    if (const double found = from(row); found < lowest) {
      lowest = found;
      best = row;
    }
  const std::size_t k = std::clamp<std::size_t>(best, 1, last - 1);
  const double left = severity_[k - 1] - severity_[k], right = severity_[k + 1] - severity_[k], centre = from(k);
  const double slope_left = (from(k - 1) - centre) / left, slope_right = (from(k + 1) - centre) / right;
  const double curvature = (slope_right - slope_left) / (right - left); // cost = centre + slope x + curvature x^2
  const double slope = slope_left - curvature * left, range = severity_.back() - severity_.front();
  if (!(curvature > 0)) return {severity_[best], range, lowest, lowest + condition.log_determinant[best]};
  const double x =
      std::clamp(severity_[k] - slope / (2 * curvature), severity_.front(), severity_.back()) - severity_[k];
  const double least = std::max(0.0, centre + (slope + curvature * x) * x);
  return {severity_[k] + x, 1 / std::sqrt(curvature), least, least + condition.log_determinant[k]};
}

/// The conditions' readings, weighted by their likelihoods.
Estimate SeverityTable::estimate(std::span<const double> signature, double rms_mean) const noexcept {
  std::array<Reading, max_conditions> readings{};
  const std::span<Reading> all = std::span(readings).first(conditions_.size());
  for (std::size_t c = 0; c < all.size(); ++c)
    all[c] = read(conditions_[c], signature);
  const double lowest = std::ranges::min_element(all, {}, &Reading::cost)->cost;
  double total = 0, mean = 0, square = 0;
  for (const Reading &r : all) {
    const double weight = std::exp(-0.5 * (r.cost - lowest));
    total += weight;
    mean += weight * r.severity;
    square += weight * (r.deviation * r.deviation + r.severity * r.severity);
  }
  mean /= total;
  const double half = normal_95 * std::sqrt(std::max(0.0, square / total - mean * mean));
  const double misfit = std::ranges::min_element(all, {}, &Reading::misfit)->misfit;
  return {mean,
          std::max(severity_.front(), mean - half),
          std::min(severity_.back(), mean + half),
          misfit,
          by_mean_rms(rms_mean),
          band_of(mean),
          misfit <= misfit_limit_ && std::isfinite(mean) && std::isfinite(half)};
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
