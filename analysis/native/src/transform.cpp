#include "lacuna/transform.hpp"

#include <algorithm>
#include <bit>
#include <mutex>
#include <new>
#include <string>

#include "lacuna/error.hpp"

namespace lacuna {

namespace {

// FFTW's planner shares tables between plans; only execution is safe in several threads.
std::mutex &planner() {
  static std::mutex mutex;
  return mutex;
}

fftw_complex *as_fftw(std::complex<double> *z) {
  return reinterpret_cast<fftw_complex *>(z);
}

} // namespace

std::size_t next_power_of_two(std::size_t n) {
  return std::bit_ceil(n);
}

RealTransform::Buffers::Buffers(const RealTransform &transform)
    : input_memory_(fftw_malloc(transform.length() * sizeof(double))),
      spectrum_memory_(fftw_malloc(transform.lines() * sizeof(std::complex<double>))) {
  if (!input_memory_ || !spectrum_memory_) throw std::bad_alloc();
  input = {static_cast<double *>(input_memory_.get()), transform.length()};
  spectrum = {static_cast<std::complex<double> *>(spectrum_memory_.get()), transform.lines()};
  std::fill(input.begin(), input.end(), 0.0);
}

// FFTW_ESTIMATE and not FFTW_MEASURE: for 2^17 points measuring takes 1.7 s and saves 0.1 ms a transform, more than a
// whole map pays back; and the estimated plan is the same in every run, so that equal input gives equal bytes.
RealTransform::RealTransform(std::size_t length) : length_(length) {
  Buffers scratch(*this);
  const std::lock_guard lock(planner());
  plan_.reset(fftw_plan_dft_r2c_1d(static_cast<int>(length), scratch.input.data(), as_fftw(scratch.spectrum.data()),
                                   FFTW_ESTIMATE | FFTW_PRESERVE_INPUT));
  if (!plan_) throw Error("FFTW has no plan for " + std::to_string(length) + " points");
}

void RealTransform::run(Buffers &buffers) const {
  fftw_execute_dft_r2c(plan_.get(), buffers.input.data(), as_fftw(buffers.spectrum.data()));
}

void RealTransform::Destroy::operator()(fftw_plan plan) const {
  const std::lock_guard lock(planner());
  fftw_destroy_plan(plan);
}

} // namespace lacuna
