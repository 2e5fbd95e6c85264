#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "lacuna/error.hpp"
#include "lacuna/transform.hpp"

namespace lacuna {

// Eigen's transform keeps its twiddle factors and its scratch in the object: one for each set of buffers.
struct RealTransform::Buffers::Memory {
  std::vector<double> input;
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> fft{Eigen::default_fft_impl<double>(), Eigen::FFT<double>::HalfSpectrum};
};

struct RealTransform::Plan {};

RealTransform::Buffers::Buffers(const RealTransform &transform) : memory_(std::make_unique<Memory>()) {
  memory_->input.assign(transform.length(), 0.0);
  memory_->spectrum.resize(transform.lines());
  input = memory_->input;
  spectrum = memory_->spectrum;
}

RealTransform::Buffers::Buffers(Buffers &&) noexcept = default;
RealTransform::Buffers &RealTransform::Buffers::operator=(Buffers &&) noexcept = default;
RealTransform::Buffers::~Buffers() = default;

RealTransform::RealTransform(std::size_t length) : length_(length) {
  if (length < 2 || length % 2 != 0) throw Error("no transform of " + std::to_string(length) + " points: not even");
}

RealTransform::RealTransform(RealTransform &&) noexcept = default;
RealTransform &RealTransform::operator=(RealTransform &&) noexcept = default;
RealTransform::~RealTransform() = default;

void RealTransform::run(Buffers &buffers) const {
  buffers.memory_->fft.fwd(buffers.spectrum.data(), buffers.input.data(), static_cast<Eigen::Index>(length_));
}

const char *RealTransform::implementation() {
  return "Eigen";
}

} // namespace lacuna
