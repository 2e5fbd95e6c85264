#include "lacuna/onboard/fft.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace lacuna::onboard {

namespace {

std::size_t reversed(std::size_t index, int bits) noexcept {
  std::size_t result = 0;
  for (int bit = 0; bit < bits; ++bit)
    result |= (index >> bit & 1U) << (bits - 1 - bit);
  return result;
}

} // namespace

RealFft::RealFft(std::size_t length)
    : half_(length / 2), bits_(std::countr_zero(half_)), data_(length), cos_(half_), sin_(half_) {
  if (length < 16 || !std::has_single_bit(length))
    throw std::invalid_argument("FFT length must be a power of two, >= 16");
  for (std::size_t k = 0; k < half_; ++k) {
    const double angle = -std::numbers::pi * static_cast<double>(reversed(k, bits_)) / static_cast<double>(half_);
    cos_[k] = std::cos(angle);
    sin_[k] = std::sin(angle);
  }
}

std::size_t RealFft::slot(std::size_t k) const noexcept {
  return k == half_ ? half_ : reversed(k, bits_);
}

/// One radix-2 level of the whole array, whose twiddle factor is 1: for lengths that are no power of four.
void RealFft::halves() noexcept {
  for (double *part : {data_.data(), data_.data() + half_}) {
    double *a = part, *b = part + half_ / 2;
    for (std::size_t j = 0; j < half_ / 2; ++j) {
      const double sum = a[j] + b[j];
      b[j] = a[j] - b[j];
      a[j] = sum;
    }
  }
}

/// Two levels at once for one block of four quarters. With the block's roots w1, w2 = w1^2, w3 = w1^3:
///   y0, y2 = a0 +- w2 a2;  s, d = w1 a1 +- w3 a3;  outputs y0 + s, y0 - s, y2 - i d, y2 + i d
void RealFft::quarters(std::size_t block, std::size_t quarter) noexcept {
  const double c1 = cos_[2 * block], s1 = sin_[2 * block], c2 = cos_[block], s2 = sin_[block];
  const double c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
  double *__restrict re = data_.data() + 4 * quarter * block, *__restrict im = re + half_;
  const std::size_t q = quarter;
  for (std::size_t j = 0; j < q; ++j) {
    const double b1r = c1 * re[j + q] - s1 * im[j + q], b1i = c1 * im[j + q] + s1 * re[j + q];
    const double b2r = c2 * re[j + 2 * q] - s2 * im[j + 2 * q], b2i = c2 * im[j + 2 * q] + s2 * re[j + 2 * q];
    const double b3r = c3 * re[j + 3 * q] - s3 * im[j + 3 * q], b3i = c3 * im[j + 3 * q] + s3 * re[j + 3 * q];
    const double y0r = re[j] + b2r, y0i = im[j] + b2i, y2r = re[j] - b2r, y2i = im[j] - b2i;
    const double sr = b1r + b3r, si = b1i + b3i, dr = b1r - b3r, di = b1i - b3i;
    re[j] = y0r + sr;
    im[j] = y0i + si;
    re[j + q] = y0r - sr;
    im[j + q] = y0i - si;
    re[j + 2 * q] = y2r + di;
    im[j + 2 * q] = y2i - dr;
    re[j + 3 * q] = y2r - di;
    im[j + 3 * q] = y2i + dr;
  }
}

void RealFft::transform() noexcept {
  std::size_t size = half_; // of a block
  if (bits_ % 2 != 0) {
    halves();
    size /= 2;
  }
  for (; size > 1; size /= 4)
    for (std::size_t block = 0; block < half_ / size; ++block)
      quarters(block, size / 4);
}

/// With Z the transform of the packed samples, E = (Z[k] + conj Z[h-k]) / 2, O = -i (Z[k] - conj Z[h-k]) / 2 and
/// t = exp(-2 pi i k / N):  F[k] = E + t O,  F[h-k] = conj(E - t O).
void RealFft::run_and_hold(std::span<double> held) noexcept {
  transform();
  const double *re = data_.data(), *im = re + half_;
  const auto hold = [&](std::size_t at, double value) { held[at] = std::max(held[at], value); };
  hold(0, (re[0] + im[0]) * (re[0] + im[0]));
  hold(half_, (re[0] - im[0]) * (re[0] - im[0]));
  hold(1, re[1] * re[1] + im[1] * im[1]);
  for (std::size_t first = 2; first < half_; first *= 2)
    for (std::size_t p = first, m = 2 * first - 1; p < m; ++p, --m) {
      const double er = 0.5 * (re[p] + re[m]), ei = 0.5 * (im[p] - im[m]);
      const double orr = 0.5 * (im[p] + im[m]), oi = -0.5 * (re[p] - re[m]);
      const double tr = cos_[p] * orr - sin_[p] * oi, ti = cos_[p] * oi + sin_[p] * orr;
      hold(p, (er + tr) * (er + tr) + (ei + ti) * (ei + ti));
      hold(m, (er - tr) * (er - tr) + (ei - ti) * (ei - ti));
    }
}

} // namespace lacuna::onboard
