// Discrete Fourier transform of real data, F[k] = sum x[n] exp(-2 pi i n k / N).
//
// Two implementations, one chosen when Lacuna is configured (LACUNA_FFT): FFTW, which is fast and GPL, or the one that
// comes with Eigen (kissfft, BSD and MPL2), for copies that are handed on in binary form. docs/licences.md says more.
#pragma once

#include <bit>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace lacuna {

inline std::size_t next_power_of_two(std::size_t n) {
  return std::bit_ceil(n);
}

/// One plan, made once; any number of threads may run it, each with its own buffers.
class RealTransform {
public:
  class Buffers {
  public:
    explicit Buffers(const RealTransform &transform);
    Buffers(Buffers &&) noexcept;
    Buffers &operator=(Buffers &&) noexcept;
    ~Buffers();

    std::span<double> input;                  ///< N samples, zero at first
    std::span<std::complex<double>> spectrum; ///< N/2 + 1 lines

  private:
    friend class RealTransform;
    struct Memory;
    std::unique_ptr<Memory> memory_;
  };

  /// `length` even. Throws lacuna::Error where the implementation has no plan for it.
  explicit RealTransform(std::size_t length);
  RealTransform(RealTransform &&) noexcept;
  RealTransform &operator=(RealTransform &&) noexcept;
  ~RealTransform();

  std::size_t length() const { return length_; }
  std::size_t lines() const { return length_ / 2 + 1; }

  /// Fills `spectrum` from `input`, which keeps its contents.
  void run(Buffers &buffers) const;

  /// Name of the implementation, "FFTW" or "Eigen".
  static const char *implementation();

private:
  struct Plan;
  std::size_t length_;
  std::unique_ptr<Plan> plan_;
};

} // namespace lacuna
