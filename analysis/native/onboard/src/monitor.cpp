#include "lacuna/onboard/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace lacuna::onboard {

namespace {

const Configuration &checked(const Configuration &c) {
  const bool sizes = c.channels >= 1 && c.channels <= max_channels && c.section >= 3 && c.section <= c.samples &&
                     c.section <= c.padded && c.hop >= 1;
  const bool numbers = c.sampling_rate > 0 && std::isfinite(c.sampling_rate) && c.speed_after >= 0;
  if (!sizes || !numbers) throw std::invalid_argument("impossible configuration of the monitor");
  return c;
}

} // namespace

Monitor::Monitor(const Configuration &configuration)
    : setup_(checked(configuration)), fft_(setup_.padded), window_(setup_.section), channels_(setup_.channels) {
  const double step = 2 * std::numbers::pi / static_cast<double>(setup_.section - 1);
  for (std::size_t n = 0; n < window_.size(); ++n) {
    window_[n] = 0.5 * (1 - std::cos(step * static_cast<double>(n))); // eq. (6)
    window_sum_ += window_[n];
  }
  for (Channel &channel : channels_) {
    channel.ring.resize(setup_.section);
    channel.held.resize(fft_.lines());
  }
}

void Monitor::start_record() noexcept {
  taken_ = 0;
  finite_ = has_angle_ = true;
  turns_ = WholeTurns();
  for (Channel &channel : channels_) {
    channel.sum_of_squares = 0;
    std::fill(channel.held.begin(), channel.held.end(), 0.0);
  }
}

bool Monitor::push(std::span<const double> currents, double angle) noexcept {
  if (taken_ == 0) start_record();
  const double period = 1 / setup_.sampling_rate;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    channels_[c].ring[taken_ % setup_.section] = currents[c];
    channels_[c].sum_of_squares += currents[c] * currents[c];
    finite_ = finite_ && std::isfinite(currents[c]);
  }
  has_angle_ = has_angle_ && std::isfinite(angle);
  if (has_angle_ && taken_ >= first_sample_after(setup_.speed_after, period)) turns_.add(angle);
  ++taken_;
  if (finite_ && taken_ >= setup_.section && (taken_ - setup_.section) % setup_.hop == 0)
    for (std::size_t c = 0; c < channels_.size(); ++c)
      analyse_section(c);
  if (taken_ < setup_.samples) return false;
  finish_record();
  taken_ = 0;
  return true;
}

void Monitor::analyse_section(std::size_t channel) noexcept {
  const std::vector<double> &ring = channels_[channel].ring;
  const std::span<double> buffer = fft_.buffer();
  std::fill(buffer.begin(), buffer.end(), 0.0);
  const std::size_t oldest = taken_ % setup_.section, until_wrap = setup_.section - oldest;
  for (std::size_t n = 0; n < until_wrap; ++n)
    buffer[fft_.place(n)] = window_[n] * ring[oldest + n];
  for (std::size_t n = until_wrap; n < setup_.section; ++n)
    buffer[fft_.place(n)] = window_[n] * ring[n - until_wrap];
  fft_.run_and_hold(channels_[channel].held);
}

void Monitor::finish_record() noexcept {
  const auto section = static_cast<double>(setup_.section), padded = static_cast<double>(setup_.padded);
  const PeakRule rule{setup_.sampling_rate / padded, setup_.peak_above, setup_.peak_threshold, padded / section};
  const std::span<double> amplitude = fft_.buffer().first(fft_.lines()); // in order of frequency, as the rules need it
  features_.valid = finite_;
  features_.rms_mean = 0;
  for (std::size_t c = 0; finite_ && c < channels_.size(); ++c) {
    for (std::size_t k = 0; k < amplitude.size(); ++k) {
      const double sides = k == 0 || k + 1 == amplitude.size() ? 1 : 2;
      amplitude[k] = sides * std::sqrt(channels_[c].held[fft_.slot(k)]) / window_sum_;
    }
    const double rms = std::sqrt(channels_[c].sum_of_squares / static_cast<double>(setup_.samples));
    features_.channels[c] = channel_features(rms, amplitude, rule);
    features_.rms_mean += rms / static_cast<double>(channels_.size());
    features_.valid = features_.valid && std::isfinite(rms) && std::isfinite(*std::ranges::max_element(amplitude));
  }
  const MeanSpeed unknown{0, std::numeric_limits<double>::quiet_NaN()};
  features_.speed = has_angle_ ? turns_.mean_speed(1 / setup_.sampling_rate) : unknown;
}

} // namespace lacuna::onboard
