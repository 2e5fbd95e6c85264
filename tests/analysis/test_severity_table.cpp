// The severity table under harm: whatever the bytes, an error or a usable table, under the sanitizers too.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <vector>

#include "lacuna/onboard/monitor.hpp"
#include "lacuna/severity_table.hpp"
#include "malloc_trap.h"

using lacuna::SeverityTable;

namespace {

class Bytes {
public:
  template <typename T> Bytes &put(T value) {
    const auto *first = reinterpret_cast<const std::byte *>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
    return *this;
  }
  Bytes &text(const char *characters, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k)
      put(k < std::strlen(characters) ? characters[k] : '\0');
    return *this;
  }
  std::vector<std::byte> with_checksum() const {
    std::uint32_t crc = ~0U;
    for (const std::byte byte : bytes_) {
      crc ^= static_cast<std::uint32_t>(byte);
      for (int bit = 0; bit < 8; ++bit)
        crc = crc >> 1 ^ (crc & 1U ? 0xEDB88320U : 0U);
    }
    Bytes complete = *this;
    complete.put(~crc);
    return complete.bytes_;
  }
  std::vector<std::byte> &raw() { return bytes_; }

private:
  std::vector<std::byte> bytes_;
};

constexpr std::size_t n = lacuna::signature_size(1);

/// One channel, five severities, two conditions; each feature is the severity itself.
Bytes small_table() {
  static_assert(std::endian::native == std::endian::little);
  Bytes bytes;
  bytes.text("LACUNAM2", 8);
  for (const std::uint32_t count : {1, 5, 2, 2, 1000, 250, 80, 256})
    bytes.put(count);
  for (const double number : {1000.0, 5.0, 0.1, 0.3, 30.0})
    bytes.put(number);
  for (int k = 0; k < 5; ++k)
    bytes.put(0.1 * k);
  for (int k = 0; k < 5; ++k)
    bytes.put(0.3 + 0.1 * k);
  for (int condition = 0; condition < 2; ++condition) {
    for (int k = 0; k < 5; ++k)
      for (std::size_t i = 0; i < n; ++i)
        bytes.put(0.1 * k);
    for (int k = 0; k < 5; ++k)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          bytes.put(i == j ? 100.0 : 0.0);
    for (int k = 0; k < 5; ++k)
      bytes.put(0.0);
  }
  bytes.text("green", 16).put(0.0).put(0.1);
  bytes.text("red", 16).put(0.2).put(0.4);
  return bytes;
}

} // namespace

TEST(SeverityTable, ReadsWhatItSays) {
  const SeverityTable table(small_table().with_checksum());
  EXPECT_EQ(table.configuration().section, 250u);
  EXPECT_STREQ(table.bands()[1].name, "red");
  const std::vector<double> signature(n, 0.23);
  const auto found = table.estimate(signature, 0.55);
  EXPECT_NEAR(found.severity, 0.23, 1e-12);
  EXPECT_NEAR(found.high - found.severity, 1.959964 * 0.01 / std::sqrt(static_cast<double>(n)), 1e-9);
  EXPECT_NEAR(found.paper, 0.25, 1e-12);
  EXPECT_EQ(found.band, 1u);
  EXPECT_TRUE(found.covered);
}

TEST(SeverityTable, RefusesEveryTruncation) {
  const auto good = small_table().with_checksum();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(SeverityTable({good.data(), size}), std::runtime_error) << size;
}

TEST(SeverityTable, SurvivesAnyBytesBehindARightChecksum) {
  std::mt19937 random(11);
  const std::vector<double> signature(n, 0.23);
  int usable = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    Bytes harmed = small_table();
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
      harmed.raw()[random() % harmed.raw().size()] = static_cast<std::byte>(random());
    if (random() % 4 == 0) harmed.raw().resize(random() % harmed.raw().size());
    try {
      const SeverityTable table(harmed.with_checksum());
      const auto found = table.estimate(signature, 0.55);
      EXPECT_LT(found.band, table.bands().size());
      ++usable;
    } catch (const std::runtime_error &) {
    }
  }
  EXPECT_GT(usable, 25);
}

TEST(SeverityTable, AMonitorOfItsConfigurationAnalysesARecordAndAllocatesNothing) {
  const SeverityTable table(small_table().with_checksum());
  lacuna::onboard::Monitor monitor(table.configuration());
  const long before = allocations();
  bool complete = false;
  for (int k = 0; k < 1000; ++k) {
    const double current = std::cos(0.4 * k);
    complete = monitor.push({&current, 1}, 0.0);
  }
  std::array<double, n> found{};
  const bool has_peaks = lacuna::signature({monitor.features().channels.data(), 1}, found);
  const auto estimate = table.estimate(found, monitor.features().rms_mean);
  EXPECT_EQ(allocations(), before);
  EXPECT_TRUE(complete && has_peaks);
  EXPECT_LE(estimate.low, estimate.high);
  EXPECT_NEAR(monitor.features().channels[0].frequency, 0.4 * 1000 / (2 * 3.14159265), 0.1);
}
