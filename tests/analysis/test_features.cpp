#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lacuna/error.hpp"
#include "lacuna/features.hpp"

using lacuna::first_peak;
using lacuna::mean_speed;

namespace {

std::vector<double> lines(std::initializer_list<double> values) {
  return values;
}

std::vector<double> angle(double start, double speed, double acceleration, std::size_t samples = 10001) {
  std::vector<double> phi(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = 1e-4 * static_cast<double>(k);
    phi[k] = start + speed * t + 0.5 * acceleration * t * t;
  }
  return phi;
}

} // namespace

TEST(Rms, IsEquationSeven) {
  const std::vector<double> x{1, -2, 3, -4};
  EXPECT_DOUBLE_EQ(lacuna::rms(x), std::sqrt(30.0 / 4));
}

TEST(FirstPeak, IsTheFirstLargeEnoughAndNotTheLargest) {
  EXPECT_EQ(first_peak(lines({9, 0, 3, 0, 1.5, 0, 10, 0}), 1, 0.5, 0.1), 2u);
}

TEST(FirstPeak, MustLieAboveTheFrequency) {
  EXPECT_EQ(first_peak(lines({0, 5, 0, 6, 0}), 2.0, 2.0, 0.1), 3u);
}

TEST(FirstPeak, MustExceedTheShareOfTheLargestLineEvenIfThatIsDirect) {
  EXPECT_EQ(first_peak(lines({30, 0, 2, 0, 4, 0}), 1, 0.5, 0.1), 4u);
}

TEST(FirstPeak, OfAPlateauIsItsFirstLine) {
  EXPECT_EQ(first_peak(lines({0, 1, 3, 3, 1}), 1, 0.5, 0.1), 2u);
}

TEST(FirstPeak, ThereMayBeNone) {
  EXPECT_FALSE(first_peak(lines({5, 4, 3, 2, 1}), 1, 0.5, 0.1));
  EXPECT_FALSE(first_peak(lines({0, 0, 0, 0}), 1, 0.5, 0.1));
}

TEST(MeanSpeed, OfUniformRotationIsItsSpeed) {
  const auto speed = mean_speed(angle(1.0, 105.0, 0), 1e-4, 0.3);
  EXPECT_EQ(speed.turns, 11);
  EXPECT_NEAR(speed.value, 105.0, 1e-9);
}

TEST(MeanSpeed, OfAnAcceleratingRotorIsTheMeanOverWholeTurns) {
  const auto speed = mean_speed(angle(0, 50.0, 30.0), 1e-4, 0.3);
  const double w = 50 + 30 * 0.3001; // at the first sample later than 0.3 s
  const double travel = 2 * std::numbers::pi * speed.turns;
  const double duration = (-w + std::sqrt(w * w + 2 * 30 * travel)) / 30;
  EXPECT_NEAR(speed.value, travel / duration, 1e-6);
}

TEST(MeanSpeed, KeepsItsSign) {
  EXPECT_NEAR(mean_speed(angle(0, -105.0, 0), 1e-4, 0.3).value, -105.0, 1e-9);
}

TEST(MeanSpeed, NeedsAWholeTurn) {
  const auto speed = mean_speed(angle(0, 5.0, 0), 1e-4, 0.3);
  EXPECT_EQ(speed.turns, 0);
  EXPECT_TRUE(std::isnan(speed.value));
  EXPECT_EQ(mean_speed(angle(0, 5.0, 0, 10), 1e-4, 0.3).turns, 0);
}

TEST(MeanSpeed, CountsTurnsUpToTheLastSample) {
  EXPECT_EQ(mean_speed(angle(0, 2 * std::numbers::pi / 0.4, 0, 4001), 1e-4, 0).turns, 0);
  EXPECT_EQ(mean_speed(angle(0, 2 * std::numbers::pi / 0.3998, 0, 4001), 1e-4, 0).turns, 1);
}

TEST(BetweenLines, FindsTheTopOfAHannPeak) {
  std::vector<double> peak(9);
  for (std::size_t k = 0; k < peak.size(); ++k)
    peak[k] = std::exp(-0.1 * std::pow(static_cast<double>(k) - 4.3, 2));
  EXPECT_NEAR(lacuna::between_lines(peak, 4), 4.3, 1e-12);
  EXPECT_EQ(lacuna::between_lines(lines({0, 1, 0}), 1), 1.0);
}

TEST(Harmonics, AreTheLargestLinesNearMultiplesOfTheFundamental) {
  const auto found = lacuna::harmonic_amplitudes(lines({7, 0, 0, 0, 0, 5, 1, 0, 0, 0, 3, 4, 0, 0, 9, 0}), 5.2, 1);
  EXPECT_EQ(found, (std::array<double, 4>{7, 5, 4, 0}));
}
