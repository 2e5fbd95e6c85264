// Each implementation of the transform against one in extended precision, written here: so any two are equal to 1e-12.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include "lacuna/transform.hpp"

using lacuna::RealTransform;
using Extended = std::complex<long double>;

namespace {

std::vector<double> noise(std::size_t length) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> x(length);
  for (double &value : x)
    value = normal(random);
  return x;
}

/// Decimation in time down to odd lengths, which are summed as the definition says.
std::vector<Extended> reference(const std::vector<Extended> &x) {
  const std::size_t n = x.size();
  std::vector<Extended> result(n);
  const auto root = [&](std::size_t k) {
    return std::polar(1.0L, -2 * std::numbers::pi_v<long double> * static_cast<long double>(k % n) / n);
  };
  if (n % 2 != 0) {
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        result[k] += x[j] * root(j * k);
    return result;
  }
  std::vector<Extended> even, odd;
  for (std::size_t j = 0; j < n; j += 2) {
    even.push_back(x[j]);
    odd.push_back(x[j + 1]);
  }
  even = reference(even);
  odd = reference(odd);
  for (std::size_t k = 0; k < n / 2; ++k) {
    const Extended turned = root(k) * odd[k];
    result[k] = even[k] + turned;
    result[k + n / 2] = even[k] - turned;
  }
  return result;
}

/// Largest difference over the largest line.
double error(const RealTransform &transform, const std::vector<double> &x, RealTransform::Buffers &work) {
  std::copy(x.begin(), x.end(), work.input.begin());
  transform.run(work);
  const auto expected = reference({x.begin(), x.end()});
  long double difference = 0, largest = 0;
  for (std::size_t k = 0; k < transform.lines(); ++k) {
    difference = std::max(difference, std::abs(Extended(work.spectrum[k]) - expected[k]));
    largest = std::max(largest, std::abs(expected[k]));
  }
  return static_cast<double>(difference / largest);
}

} // namespace

// Rounding grows as the square root of the number of levels: 17 of them at 1.1e-16, and ten times that for twiddle
// factors, stay below half of the 1e-12 by which two implementations may differ.
TEST(Transform, EqualsExtendedPrecision) {
  for (const std::size_t length : {2u, 6u, 16u, 30u, 100u, 1000u, 4096u, 131072u}) {
    const RealTransform transform(length);
    RealTransform::Buffers work(transform);
    EXPECT_LT(error(transform, noise(length), work), 0.5e-12) << length;
  }
}

TEST(Transform, KeepsItsInput) {
  const RealTransform transform(1000);
  RealTransform::Buffers work(transform);
  const auto x = noise(1000);
  error(transform, x, work);
  EXPECT_TRUE(std::equal(x.begin(), x.end(), work.input.begin()));
}

TEST(Transform, ServesThreadsAtOnce) {
  const RealTransform transform(4096);
  std::vector<double> errors(4, 1);
  std::vector<std::jthread> threads;
  for (double &result : errors)
    threads.emplace_back([&] {
      RealTransform::Buffers work(transform);
      result = error(transform, noise(4096), work);
    });
  threads.clear();
  for (const double result : errors)
    EXPECT_LT(result, 0.5e-12);
}
