// The on-board chain against the desktop's, and its memory.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include "lacuna/onboard/fft.hpp"
#include "malloc_trap.h"
#include "paper_stream.hpp"

using lacuna::onboard::Monitor;
using lacuna::onboard::RealFft;

namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

lacuna::Chain paper_chain() {
  return lacuna::Chain(paper_settings());
}

void expect_close(double a, double b) {
  if (std::isnan(b))
    EXPECT_TRUE(std::isnan(a));
  else
    EXPECT_NEAR(a, b, 1e-9 * std::max(1.0, std::abs(b)));
}

} // namespace

class RealFftOfLength : public testing::TestWithParam<std::size_t> {};

TEST_P(RealFftOfLength, AgreesWithTheSumThatDefinesIt) {
  const std::size_t length = GetParam();
  RealFft fft(length);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> x(length), held(fft.lines(), 0.0);
  for (double &value : x)
    value = normal(random);
  for (std::size_t n = 0; n < length; ++n)
    fft.buffer()[fft.place(n)] = x[n];
  fft.run_and_hold(held);
  for (std::size_t k = 0; k < fft.lines(); ++k) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < length; ++n)
      sum += x[n] *
             std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * n % length) / static_cast<double>(length));
    EXPECT_NEAR(held[fft.slot(k)], std::norm(sum), 1e-11 * static_cast<double>(length)) << "line " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(PowersOfTwo, RealFftOfLength, testing::Values(16, 32, 64, 128, 256, 1024, 2048));

TEST(RealFft, RefusesOtherLengths) {
  EXPECT_THROW(RealFft(8), std::invalid_argument);
  EXPECT_THROW(RealFft(100), std::invalid_argument);
}

TEST(Monitor, EqualsTheDesktopChain) {
  const lacuna::Chain chain = paper_chain();
  Monitor monitor(configuration_of(chain));
  for (const double zeta : {0.0, 0.34}) {
    const auto rows = simulated(zeta, 100000);
    std::array<std::vector<double>, 5> columns;
    for (const auto &row : rows)
      for (std::size_t c = 0; c < 5; ++c)
        columns[c].push_back(row[c]);
    const auto desktop = chain.analyse({columns[0], columns[1], columns[2]}, columns[4]);
    for (std::size_t k = 0; k < rows.size(); ++k)
      ASSERT_EQ(monitor.push({rows[k].data(), 3}, rows[k][4]), k + 1 == rows.size());
    const auto &found = monitor.features();
    ASSERT_TRUE(found.valid);
    expect_close(found.rms_mean, desktop.rms_mean);
    expect_close(found.speed.value, desktop.speed.value);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(found.channels[c].peak_bin, desktop.channels[c].peak_bin);
      expect_close(found.channels[c].rms, desktop.channels[c].rms);
      expect_close(found.channels[c].peak_amplitude, desktop.channels[c].peak_amplitude);
      expect_close(found.channels[c].frequency, desktop.channels[c].frequency);
      for (std::size_t h = 0; h < lacuna::harmonics; ++h)
        expect_close(found.channels[c].harmonic[h], desktop.channels[c].harmonic[h]);
    }
  }
}

TEST(Monitor, ARecordWithAGapIsNotValidAndTheNextOneIs) {
  Monitor monitor({1, 100, 50, 10, 64, 100, 1, 0.1, 0});
  const auto record = [&](std::size_t gap) {
    for (std::size_t k = 0; k < 100; ++k) {
      const double current = k == gap ? not_measured : std::sin(0.7 * static_cast<double>(k));
      if (monitor.push({&current, 1}, not_measured)) return monitor.features();
    }
    return lacuna::onboard::RecordFeatures{};
  };
  EXPECT_FALSE(record(70).valid);
  const auto good = record(1000);
  EXPECT_TRUE(good.valid);
  EXPECT_GT(good.channels[0].peak_bin, 0);
  EXPECT_EQ(good.speed.turns, 0);
}

// Any double is taken in finite time; an angle that no shaft can have leaves the speed unknown.
TEST(Monitor, TakesAnyAngle) {
  const auto chain = paper_chain();
  const auto configuration = configuration_of(chain);
  const double largest = std::numeric_limits<double>::max();
  for (const double absurd : {1e300, -1e300, largest, std::numeric_limits<double>::infinity(), 1e18}) {
    Monitor monitor(configuration);
    const std::vector<double> currents(configuration.channels, 0.5);
    bool done = false;
    for (std::size_t k = 0; !done; ++k)
      done = monitor.push(currents, k % 2 == 0 ? 0.1 : absurd);
    EXPECT_EQ(monitor.features().speed.turns, 0) << absurd;
  }
}

// The squares of such currents are beyond what a double holds.
TEST(Monitor, ARecordWhoseFeaturesAreNotFiniteIsNotValid) {
  Monitor monitor({1, 100, 50, 10, 64, 100, 1, 0.1, 0});
  for (const double current : {1e200, 1e-3}) {
    while (!monitor.push({&current, 1}, not_measured))
      ;
    EXPECT_EQ(monitor.features().valid, current < 1);
  }
}

// As a table with a right checksum may ask for.
TEST(Monitor, SpeedIsNeverTakenAfterATimeThatNeverComes) {
  Monitor monitor({1, 100, 50, 10, 64, 1e300, 1, 0.1, 1e300});
  const double current = 1;
  double angle = 0;
  while (!monitor.push({&current, 1}, angle += 1))
    ;
  EXPECT_EQ(monitor.features().speed.turns, 0);
}

TEST(Monitor, RefusesAnImpossibleConfiguration) {
  EXPECT_THROW(Monitor({0, 100, 50, 10, 64, 100, 1, 0.1, 0}), std::invalid_argument);
  EXPECT_THROW(Monitor({1, 100, 200, 10, 256, 100, 1, 0.1, 0}), std::invalid_argument);
  EXPECT_THROW(Monitor({1, 100, 50, 10, 32, 100, 1, 0.1, 0}), std::invalid_argument);
  EXPECT_THROW(Monitor({1, 100, 50, 0, 64, 100, 1, 0.1, 0}), std::invalid_argument);
}

TEST(MallocTrap, IsSet) {
  const long before = allocations();
  const std::vector<double> memory(1000);
  void *volatile block = std::malloc(10);
  std::free(block);
  EXPECT_EQ(allocations() - before, 2);
}

TEST(Monitor, ALongStreamWithoutAllocation) {
  const lacuna::Chain chain = paper_chain();
  Monitor monitor(configuration_of(chain));
  const auto rows = simulated(0.2, 100000);
  const long before = allocations();
  int records = 0;
  for (int second = 0; second < STREAM_SECONDS; ++second)
    for (const auto &row : rows)
      records += monitor.push({row.data(), 3}, row[4]) ? 1 : 0;
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_EQ(records, STREAM_SECONDS);
  EXPECT_EQ(monitor.features().channels[0].peak_bin, 44);
}
