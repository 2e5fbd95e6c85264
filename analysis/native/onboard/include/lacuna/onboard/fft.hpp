// Squared magnitude of the discrete Fourier transform of real data, on fixed memory.
//
// The N real samples are packed as N/2 complex ones. Radix-4 butterflies run in place from natural to bit-reversed
// order, in which all butterflies of a block share one twiddle factor; the real spectrum is separated in that order
// too, where line k and line N/2 - k lie mirrored in one block. Nothing is ever reordered.
//   Cooley and Tukey, Mathematics of Computation 19 (1965) 297.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::onboard {

class RealFft {
public:
  /// `length` a power of two, at least 16. Allocates 2 `length` doubles, here and never again.
  /// Throws std::invalid_argument for another length.
  explicit RealFft(std::size_t length);

  std::size_t length() const { return 2 * half_; }
  std::size_t lines() const { return half_ + 1; }

  /// The N samples to be transformed, sample n at place(n): even ones, then odd ones. Also free for other use between
  /// two runs.
  std::span<double> buffer() { return data_; }
  std::size_t place(std::size_t n) const { return n / 2 + (n % 2) * half_; }

  /// held[slot(k)] = max(held[slot(k)], |F[k]|^2) for every line k; `held` [lines]. Overwrites the buffer.
  void run_and_hold(std::span<double> held) noexcept;
  /// Where line k is held.
  std::size_t slot(std::size_t k) const noexcept;

private:
  void transform() noexcept;
  void halves() noexcept;
  void quarters(std::size_t block, std::size_t quarter) noexcept;

  std::size_t half_;
  int bits_; // 2^bits_ = half_
  std::vector<double> data_;
  std::vector<double> cos_, sin_; // of minus half a turn times the bit-reversed fraction of the index
};

} // namespace lacuna::onboard
