// Unknown forces and linear responses on closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lacuna_analysis.h"

namespace {

/// A force read at once, twice, 0.5 s apart: covariance s^2 exp(-|t| / l) + n^2 of two numbers.
struct Pair {
  std::array<double, 2> time{3, 3.5}, feed{1, 1}, noise{0.3, 0};
  lacuna_linear_model model{2, 0, 1, 1, time.data(), nullptr, nullptr, nullptr, feed.data(), noise.data(), nullptr};
  std::array<unsigned char, 2> seen{1, 1};
  std::array<double, 2> readings{0.7, -0.2};

  static double own(double size) { return size * size + 0.09; }
  static double shared(double size, double constant) { return size * size * std::exp(-0.5 / constant); }
};

/// As many hypotheses as do not fill the lanes: sizes 1, 2, ..., time constants 1, 1/2, ...
struct Hypotheses {
  std::vector<int> column, sensor;
  std::vector<double> size, time;

  explicit Hypotheses(std::size_t count) : column(count, 0), sensor(count, -1), size(count), time(count) {
    for (std::size_t k = 0; k < count; ++k) {
      size[k] = static_cast<double>(k + 1);
      time[k] = 1 / size[k];
    }
  }
  lacuna_latent latent() const { return {size.size(), 1, column.data(), sensor.data(), size.data(), time.data()}; }
};

/// What the filter of one hypothesis does, in arrays of its own.
struct Gains {
  std::array<double, 2> row{}, gain{}, deviation{}, keep{};
  lacuna_latent_gains gains{row.data(), gain.data(), deviation.data(), nullptr, keep.data()};
  int failed;

  Gains(const Pair &pair, const lacuna_latent &latent)
      : failed(lacuna_latent_filter(&pair.model, &latent, pair.seen.data(), &gains)) {}
};

} // namespace

TEST(Latent, EvidenceIsThatOfTheDenseCovariance) {
  const Pair pair;
  for (const std::size_t count : {std::size_t{1}, std::size_t{8}, std::size_t{11}}) {
    const Hypotheses hypotheses(count);
    const lacuna_latent latent = hypotheses.latent();
    std::vector<double> gram(count), logs(count);
    ASSERT_EQ(lacuna_latent_evidence(&pair.model, &latent, pair.readings.data(), pair.seen.data(), 1, gram.data(),
                                     logs.data()),
              0);
    for (std::size_t k = 0; k < count; ++k) {
      const double a = Pair::own(hypotheses.size[k]), b = Pair::shared(hypotheses.size[k], hypotheses.time[k]);
      const double det = a * a - b * b;
      EXPECT_NEAR(logs[k], std::log(det / (0.09 * 0.09)), 1e-12);
      EXPECT_NEAR(gram[k], (a * (0.49 + 0.04) - 2 * b * 0.7 * -0.2) / det, 1e-12 * gram[k]);
    }
  }
}

TEST(Latent, WhitenedReadingsAreTheSumOfSquares) {
  const Pair pair;
  const Hypotheses hypotheses(1);
  const lacuna_latent latent = hypotheses.latent();
  const Gains gains(pair, latent);
  ASSERT_EQ(gains.failed, 0);
  auto white = pair.readings;
  lacuna_latent_whiten(&pair.model, &gains.gains, 1, white.data(), pair.seen.data(), 1);
  const double a = Pair::own(1), b = Pair::shared(1, 1);
  EXPECT_NEAR(white[0], 0.7 / std::sqrt(a), 1e-14);
  EXPECT_NEAR(white[1], (-0.2 - b / a * 0.7) / std::sqrt(a - b * b / a), 1e-13);
}

TEST(Latent, ColumnsAreWhitenedAlikeHoweverManyThereAre) {
  Pair pair;
  const Hypotheses hypotheses(1);
  const Gains gains(pair, hypotheses.latent());
  for (const std::size_t count : {std::size_t{1}, std::size_t{16}, std::size_t{37}}) {
    std::vector<double> data(2 * count), turned(2 * count);
    for (std::size_t j = 0; j < count; ++j) {
      data[j] = static_cast<double>(j + 1) * pair.readings[0];
      data[count + j] = static_cast<double>(j + 1) * pair.readings[1];
      turned[j] = 0.4;
      turned[count + j] = -1.1;
    }
    lacuna_latent_whiten(&pair.model, &gains.gains, 1, data.data(), pair.seen.data(), count);
    lacuna_latent_whiten_transposed(&pair.model, &gains.gains, 1, turned.data(), pair.seen.data(), count);
    for (std::size_t j = 0; j < count; ++j) {
      const double product = 0.4 * data[j] - 1.1 * data[count + j];
      const double same = pair.readings[0] * turned[j] + pair.readings[1] * turned[count + j];
      EXPECT_NEAR(data[j], static_cast<double>(j + 1) * data[0], 1e-13 * std::abs(data[j]));
      EXPECT_NEAR(product, static_cast<double>(j + 1) * same, 1e-12 * std::abs(product));
    }
  }
}

TEST(Latent, ForceIsItsMeanGivenTheReadings) {
  Pair pair;
  const Hypotheses hypotheses(1);
  const lacuna_latent latent = hypotheses.latent();
  std::array<double, 2> mean{}, deviation{};
  pair.seen = {0, 1}; // the first from what is read later
  ASSERT_EQ(
      lacuna_latent_smooth(&pair.model, &latent, pair.readings.data(), pair.seen.data(), mean.data(), deviation.data()),
      0);
  const double a = Pair::own(1), b = Pair::shared(1, 1);
  EXPECT_NEAR(mean[0], b / a * -0.2, 1e-14);
  EXPECT_NEAR(deviation[0], std::sqrt(1 - b * b / a), 1e-14);
  EXPECT_NEAR(mean[1], 1 / a * -0.2, 1e-14);
  EXPECT_NEAR(deviation[1], std::sqrt(1 - 1 / a), 1e-14);
}

TEST(Latent, AVarianceThatIsNoNumberIsSaid) {
  const Pair pair;
  Hypotheses hypotheses(1);
  hypotheses.size[0] = std::nan("");
  const lacuna_latent latent = hypotheses.latent();
  auto readings = pair.readings;
  std::array<double, 2> mean{}, deviation{};
  double gram = 0, log = 0;
  EXPECT_EQ(lacuna_latent_evidence(&pair.model, &latent, readings.data(), pair.seen.data(), 1, &gram, &log), 1);
  EXPECT_EQ(Gains(pair, latent).failed, 1);
  EXPECT_EQ(
      lacuna_latent_smooth(&pair.model, &latent, readings.data(), pair.seen.data(), mean.data(), deviation.data()), 1);
}

TEST(LinearResponse, IsTheRecursionWrittenOut) {
  // x -> x / 2 + q, y = x + 2 q, from rest
  const std::array<double, 4> time{0, 1, 2, 3}, read{1, 1, 1, 1}, feed{2, 2, 2, 2};
  const std::array<double, 3> step{0.5, 0.5, 0.5}, drive{1, 1, 1};
  const lacuna_linear_model model{4,           1,           1,       1,      time.data(), step.data(), drive.data(),
                                  read.data(), feed.data(), nullptr, nullptr};
  const std::array<int, 2> columns{0, 0};
  const std::array<double, 8> courses{1, 0, 1, 2, 1, 0, 1, 0}; // a step, and one sample of two
  std::array<double, 8> held{};
  lacuna_linear_response(&model, columns.data(), courses.data(), 2, 1, 1, held.data());
  EXPECT_EQ(held, (std::array<double, 8>{2, 0, 3, 4, 3.5, 2, 3.75, 1}));
  std::array<double, 4> between{}; // linear from sample to sample, at every other one
  lacuna_linear_response(&model, columns.data(), courses.data(), 2, 0, 2, between.data());
  EXPECT_EQ(between, (std::array<double, 4>{2, 0, 3.5, 1.5}));
}
