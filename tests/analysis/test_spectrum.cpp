#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "lacuna/error.hpp"
#include "lacuna/spectrum.hpp"

using lacuna::HannWindow;
using lacuna::SectionSpectrum;
using std::numbers::pi;

namespace {

std::vector<double> tone(std::size_t samples, double cycles_per_sample, double amplitude, double phase = 0.3) {
  std::vector<double> x(samples);
  for (std::size_t n = 0; n < samples; ++n)
    x[n] = amplitude * std::cos(2 * pi * cycles_per_sample * static_cast<double>(n) + phase);
  return x;
}

std::vector<double> noise(std::size_t samples) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> x(samples);
  for (double &value : x)
    value = normal(random);
  return x;
}

Eigen::ArrayXd squared_magnitude(const SectionSpectrum &spectrum, const std::vector<double> &section) {
  auto work = spectrum.buffers();
  Eigen::ArrayXd out;
  spectrum.squared_magnitude(section, work, out);
  return out;
}

/// The window's own transform at `w` radians a sample over its sum, in closed form: eq. (6) is 1/2 plus two halves of a
/// cosine, each a Dirichlet kernel.
double hann_response(std::size_t samples, double w) {
  const auto n = static_cast<double>(samples);
  const double side = 2 * pi / (n - 1);
  const auto kernel = [&](double x) { return x == 0 ? n : std::sin(n * x / 2) / std::sin(x / 2); };
  const auto response = [&](double x) { return 0.5 * kernel(x) + 0.25 * (kernel(x - side) + kernel(x + side)); };
  return std::abs(response(w) / response(0));
}

} // namespace

TEST(HannWindow, IsEquationSix) {
  const HannWindow window(1001);
  EXPECT_EQ(window.values()[0], 0.0);
  EXPECT_NEAR(window.values()[1000], 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(window.values()[500], 1.0);
  EXPECT_NEAR(window.values()[250], 0.5, 1e-15);
  EXPECT_NEAR(window.sum(), 1000 / 2.0, 1e-10);
  EXPECT_NEAR(window.energy(), 3 * 1000 / 8.0, 1e-10);
  EXPECT_THROW(HannWindow(2), lacuna::Error);
}

TEST(SectionSpectrum, AgreesWithTheSumThatDefinesIt) {
  const SectionSpectrum spectrum(HannWindow(50), 128);
  const auto x = noise(50);
  const auto lines = squared_magnitude(spectrum, x);
  ASSERT_EQ(lines.size(), 65);
  for (int k = 0; k <= 64; ++k) {
    std::complex<double> sum = 0;
    for (int n = 0; n < 50; ++n)
      sum += spectrum.window().values()[n] * x[n] * std::polar(1.0, -2 * pi * k * n / 128.0);
    EXPECT_NEAR(lines[k], std::norm(sum), 1e-12 * lines.maxCoeff());
  }
}

TEST(SectionSpectrum, PreservesEnergy) {
  const SectionSpectrum spectrum(HannWindow(25000), 131072);
  const auto x = noise(25000);
  double energy = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    energy += std::pow(spectrum.window().values()[static_cast<long>(n)] * x[n], 2);
  const double mean_square = energy / spectrum.window().energy();
  EXPECT_NEAR(spectrum.power(squared_magnitude(spectrum, x)).sum() / mean_square, 1.0, 1e-12);
}

TEST(SectionSpectrum, ToneOnALineReadsItsAmplitude) {
  const SectionSpectrum spectrum(HannWindow(25000), 131072);
  const auto amplitude = spectrum.amplitude(squared_magnitude(spectrum, tone(25000, 20000 / 131072.0, 2.5)));
  Eigen::Index largest = 0;
  EXPECT_NEAR(amplitude.maxCoeff(&largest), 2.5, 1e-10);
  EXPECT_EQ(largest, 20000);
}

TEST(SectionSpectrum, ToneOffALineReadsAsTheWindowLeaks) {
  const SectionSpectrum spectrum(HannWindow(25000), 131072);
  for (const double off : {0.1, 0.25, 0.5}) {
    const auto amplitude = spectrum.amplitude(squared_magnitude(spectrum, tone(25000, (20000 + off) / 131072.0, 2.5)));
    for (const int line : {19997, 20000, 20001, 20004}) {
      const double w = 2 * pi * (line - 20000 - off) / 131072.0;
      EXPECT_NEAR(amplitude[line], 2.5 * hann_response(25000, w), 1e-9) << "off " << off << ", line " << line;
    }
  }
}

TEST(SectionSpectrum, ScallopingWithoutPaddingIsHannsFifteenPercent) {
  const SectionSpectrum spectrum(HannWindow(4096), 4096);
  const auto amplitude = spectrum.amplitude(squared_magnitude(spectrum, tone(4096, 1000.5 / 4096, 1.0)));
  EXPECT_NEAR(amplitude.maxCoeff(), 8 / (3 * pi), 1e-3);
}

TEST(SectionSpectrum, ConstantReadsItsValueOnTheFirstLine) {
  const SectionSpectrum spectrum(HannWindow(1000), 4096);
  const auto lines = squared_magnitude(spectrum, std::vector<double>(1000, -0.7));
  EXPECT_NEAR(spectrum.amplitude(lines)[0], 0.7, 1e-13);
}

TEST(SectionSpectrum, RefusesPaddingBelowTheSection) {
  EXPECT_THROW(SectionSpectrum(HannWindow(100), 64), lacuna::Error);
  EXPECT_THROW(SectionSpectrum(HannWindow(100), 101), lacuna::Error);
}

TEST(PeakHold, KeepsTheLargestOfEachLine) {
  lacuna::PeakHold hold(3);
  hold.add(Eigen::Array3d(1, 5, 2));
  hold.add(Eigen::Array3d(3, 4, 2));
  EXPECT_TRUE((hold.value() == Eigen::Array3d(3, 5, 2)).all());
}

TEST(NextPowerOfTwo, OfTheWholeRecord) {
  EXPECT_EQ(lacuna::next_power_of_two(100000), 131072u);
  EXPECT_EQ(lacuna::next_power_of_two(131072), 131072u);
  EXPECT_EQ(lacuna::next_power_of_two(131073), 262144u);
}
