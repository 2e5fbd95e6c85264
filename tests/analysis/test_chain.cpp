#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "lacuna/chain.hpp"
#include "lacuna/error.hpp"
#include "lacuna_analysis.h"
#include "paper.hpp"
#include "reference_actuator.h"

namespace {

constexpr int samples = 100000;

struct Record {
  std::array<std::vector<double>, 5> columns; // currents a, b, c, speed, angle

  explicit Record(double zeta) {
    reference_parameters parameters = reference_defaults();
    parameters.zeta = zeta;
    std::vector<std::array<double, 5>> rows(samples);
    EXPECT_GT(reference_simulate(&parameters, 1e-5, samples, reinterpret_cast<double(*)[5]>(rows.data())), 0);
    for (std::size_t c = 0; c < 5; ++c)
      for (const auto &row : rows)
        columns[c].push_back(row[c]);
  }

  std::vector<std::span<const double>> currents() const { return {columns[0], columns[1], columns[2]}; }
};

class PaperChain : public testing::Test {
protected:
  const lacuna::Chain chain{paper_settings()};

  lacuna::Features of(double zeta) const {
    const Record record(zeta);
    return chain.analyse(record.currents(), record.columns[4]);
  }
};

lacuna_settings paper_settings_in_c() {
  static const std::array<const char *, 3> currents{"filter[1].y", "filter[2].y", "filter[3].y"};
  return {100000.0, 1.0, 3, currents.data(), "rotor.phi", 0.25, 0.67, LACUNA_PAD_RECORD, 5.0, 0.1, 0.3};
}

std::string refusal_of(const lacuna::Settings &settings) {
  try {
    const lacuna::Chain chain(settings);
  } catch (const lacuna::Error &error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST(Settings, SectionsArePaddedAsTheySay) {
  lacuna::Settings settings = paper_settings();
  EXPECT_EQ(settings.samples(), 100000u);
  EXPECT_EQ(settings.padded_length(25000), 131072u);
  settings.padding = lacuna::Settings::Padding::section;
  EXPECT_EQ(settings.padded_length(25000), 32768u);
  settings.padding = lacuna::Settings::Padding::none;
  EXPECT_EQ(settings.padded_length(25000), 25000u);
  EXPECT_EQ(settings.padded_length(25001), 25002u);
}

TEST(Settings, NameTheEntryThatIsWrong) {
  lacuna::Settings rate = paper_settings(), overlap = paper_settings(), signals = paper_settings();
  rate.sampling_rate = -1;
  overlap.overlap = 1.5;
  signals.currents.clear();
  EXPECT_EQ(refusal_of(rate), "settings: recording.sampling_rate must be above zero");
  EXPECT_EQ(refusal_of(overlap), "settings: spectrum.overlap must be between 0 and 1");
  EXPECT_EQ(refusal_of(signals), "settings: signals.currents must name at least one signal");
}

TEST_F(PaperChain, ReproducesThePublishedMapFromAnIndependentSimulation) {
  std::map<double, lacuna::Features> map;
  for (const auto &[first, last] : paper_bands)
    for (const double edge : {first, last})
      map.emplace(edge, of(edge));
  const std::array<double, 4> rise{0.0160, 0.0994, 0.0611, 0.1969}; // A, of the consistent set
  for (std::size_t b = 0; b < 4; ++b) {
    const auto &[first, last] = paper_bands[b];
    EXPECT_NEAR(map.at(last).rms_mean - map.at(first).rms_mean, rise[b], 0.5e-3) << first;
  }
  for (const auto &[zeta, features] : map) {
    const auto &channel = features.channels;
    for (const auto &phase : channel)
      EXPECT_EQ(phase.peak_bin, zeta < 0.335 ? 44 : 43) << zeta;
    EXPECT_LT(channel[0].rms, channel[2].rms) << zeta;
    EXPECT_LT(channel[2].rms, channel[1].rms) << zeta;
  }
  EXPECT_NEAR(map.at(0.0).speed.value, 105.38, 0.05);
  EXPECT_NEAR(map.at(0.33).speed.value, 104.31, 0.05);
  EXPECT_NEAR(map.at(0.50).speed.value, 102.36, 0.05);
}

TEST_F(PaperChain, ManyThreadsGiveTheSameBytes) {
  const Record record(0.2);
  const auto alone = chain.analyse(record.currents(), record.columns[4]);
  std::array<std::vector<lacuna::Features>, 4> results;
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (auto &result : results)
    threads.emplace_back([&] { result.push_back(chain.analyse(record.currents(), record.columns[4])); });
  for (auto &thread : threads)
    thread.join();
  for (const auto &result : results)
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(result[0].channels[c].rms, alone.channels[c].rms);
      EXPECT_TRUE((result[0].held[c] == alone.held[c]).all());
    }
}

TEST_F(PaperChain, RefusesRecordsOfAnotherShape) {
  const std::vector<double> short_record(99999), record(samples);
  EXPECT_THROW(chain.analyse({short_record, record, record}, {}), lacuna::Error);
  EXPECT_THROW(chain.analyse({record, record}, {}), lacuna::Error);
}

TEST_F(PaperChain, RefusesMissingSamplesNamingChannelAndTime) {
  std::vector<double> gap(samples), record(samples);
  gap[25000] = std::numeric_limits<double>::quiet_NaN();
  try {
    chain.analyse({record, gap, record}, {});
    FAIL();
  } catch (const lacuna::Error &error) {
    EXPECT_NE(std::string(error.what()).find(chain.settings().currents[1]), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("0.25"), std::string::npos);
  }
}

TEST_F(PaperChain, SilenceHasNoPeakAndNoSpeed) {
  const std::vector<double> silence(samples);
  const auto features = chain.analyse({silence, silence, silence}, silence);
  EXPECT_EQ(features.channels[0].peak_bin, -1);
  EXPECT_TRUE(std::isnan(features.channels[0].peak_hz));
  EXPECT_EQ(features.speed.turns, 0);
  EXPECT_EQ(features.rms_mean, 0);
}

TEST(CInterface, GivesTheFeaturesOfTheLibrary) {
  char message[200] = "";
  const lacuna_settings settings = paper_settings_in_c();
  lacuna_chain *chain = lacuna_chain_new(&settings, message, sizeof message);
  ASSERT_NE(chain, nullptr) << message;
  const Record record(0.1);
  const double *currents[3] = {record.columns[0].data(), record.columns[1].data(), record.columns[2].data()};
  std::array<lacuna_channel, 3> channels{};
  lacuna_summary summary{};
  std::vector<double> held(3 * lacuna_chain_lines(chain));
  ASSERT_EQ(lacuna_chain_analyse(chain, currents, record.columns[4].data(), samples, channels.data(), &summary,
                                 held.data(), message, sizeof message),
            0);
  EXPECT_EQ(channels[1].peak_bin, 44);
  EXPECT_NEAR(summary.rms_mean, 0.3119, 1e-4);
  EXPECT_EQ(held[lacuna_chain_lines(chain) + 44], channels[1].peak_amplitude);
  lacuna_chain_free(chain);
}

TEST(CInterface, WritesAMessageThatFits) {
  std::array<char, 12> message{};
  lacuna_settings settings = paper_settings_in_c();
  settings.sampling_rate = -1;
  EXPECT_EQ(lacuna_chain_new(&settings, message.data(), message.size()), nullptr);
  EXPECT_EQ(std::string(message.data()), "settings: r");
}
