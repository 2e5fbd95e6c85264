// Discrete Fourier transform of real data, F[k] = sum x[n] exp(-2 pi i n k / N), by FFTW.
#pragma once

#include <fftw3.h>

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace lacuna {

std::size_t next_power_of_two(std::size_t n);

/// One plan, made once; any number of threads may run it, each with its own buffers.
class RealTransform {
public:
  class Buffers {
  public:
    explicit Buffers(const RealTransform &transform);
    std::span<double> input;                  ///< N samples, zero at first
    std::span<std::complex<double>> spectrum; ///< N/2 + 1 lines

  private:
    struct Free {
      void operator()(void *memory) const { fftw_free(memory); }
    };
    std::unique_ptr<void, Free> input_memory_, spectrum_memory_;
  };

  explicit RealTransform(std::size_t length);

  std::size_t length() const { return length_; }
  std::size_t lines() const { return length_ / 2 + 1; }

  /// Fills `spectrum` from `input`, which keeps its contents.
  void run(Buffers &buffers) const;

private:
  struct Destroy {
    void operator()(fftw_plan plan) const;
  };
  std::size_t length_;
  std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy> plan_;
};

} // namespace lacuna
