#include "lacuna/spectrum.hpp"

#include <utility>

#include "lacuna/error.hpp"

namespace lacuna {

namespace {

// The first and the last line stand for themselves, each line between them also for its mirror image.
Eigen::ArrayXd single_sided(Eigen::ArrayXd lines) {
  lines.segment(1, lines.size() - 2) *= 2;
  return lines;
}

} // namespace

SectionSpectrum::SectionSpectrum(HannWindow window, std::size_t padded)
    : window_(std::move(window)), transform_(padded) {
  if (padded < window_.length() || padded % 2 != 0)
    throw Error("the padded length must be even and not below that of a section");
}

void SectionSpectrum::squared_magnitude(std::span<const double> section, RealTransform::Buffers &work,
                                        Eigen::ArrayXd &out) const {
  const auto n = static_cast<Eigen::Index>(window_.length());
  Eigen::Map<Eigen::ArrayXd>(work.input.data(), n) =
      window_.values() * Eigen::Map<const Eigen::ArrayXd>(section.data(), n);
  transform_.run(work);
  out = Eigen::Map<const Eigen::ArrayXcd>(work.spectrum.data(), static_cast<Eigen::Index>(lines())).abs2();
}

Eigen::ArrayXd SectionSpectrum::amplitude(const Eigen::ArrayXd &squared_magnitude) const {
  return single_sided(squared_magnitude.sqrt() / window_.sum());
}

Eigen::ArrayXd SectionSpectrum::power(const Eigen::ArrayXd &squared_magnitude) const {
  return single_sided(squared_magnitude / (static_cast<double>(padded()) * window_.energy()));
}

} // namespace lacuna
