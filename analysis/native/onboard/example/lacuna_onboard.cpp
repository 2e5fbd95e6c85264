// lacuna-onboard TABLE < RECORDING.csv
//
// The assessment chain as a target machine would run it: a severity table is read once, then rows arrive on standard
// input, `time` first and then one phase current a column, and each complete record gives one line of JSON. After the
// start nothing is allocated. Exit code 1 with a message where the table or a row cannot be used, or no record came.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "lacuna/onboard/monitor.hpp"

namespace {

using namespace lacuna;

std::vector<std::byte> contents(const char *path) {
  std::FILE *file = std::fopen(path, "rb");
  if (!file) throw std::runtime_error(std::string("cannot read ") + path);
  std::vector<std::byte> bytes;
  std::array<std::byte, 65536> piece{};
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), file))
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(n));
  std::fclose(file);
  return bytes;
}

/// Time and currents from one line; false where it does not hold exactly that many numbers.
bool parse(const char *line, std::span<double> values) {
  const char *end = line + std::strcspn(line, "\r\n");
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto [rest, error] = std::from_chars(line, end, values[k]);
    const bool last = k + 1 == values.size();
    if (error != std::errc() || (last ? rest != end : rest == end || *rest != ',')) return false;
    line = rest + 1;
  }
  return true;
}

void report(const SeverityTable &table, const onboard::RecordFeatures &features, long record) {
  std::array<double, signature_size(max_channels)> memory{};
  const std::size_t channels = table.configuration().channels;
  const std::span<double> found = std::span(memory).first(signature_size(channels));
  if (!features.valid || !signature(std::span(features.channels).first(channels), found)) {
    std::printf("{\"record\": %ld, \"covered\": false}\n", record);
    return;
  }
  const Estimate e = table.estimate(found, features.rms_mean);
  std::printf("{\"record\": %ld, \"severity\": %.17g, \"low\": %.17g, \"high\": %.17g, \"band\": \"%s\", "
              "\"misfit\": %.17g, \"paper\": %.17g, \"rms_mean\": %.17g, \"covered\": %s}\n",
              record, e.severity, e.low, e.high, table.bands()[e.band].name, e.misfit, e.paper, features.rms_mean,
              e.covered ? "true" : "false");
}

void run(const char *path) {
  const SeverityTable table(contents(path));
  onboard::Monitor monitor(table.configuration());
  std::array<double, 1 + max_channels> memory{};
  const std::span<double> row = std::span(memory).first(1 + table.configuration().channels);
  std::array<char, 1000> line{};
  long number = 0, taken = 0, records = 0;
  double start = 0;
  while (std::fgets(line.data(), static_cast<int>(line.size()), stdin)) {
    if (++number == 1 && std::strncmp(line.data(), "time", 4) == 0) continue;
    if (!parse(line.data(), row))
      throw std::runtime_error("line " + std::to_string(number) + " is not time and currents");
    if (taken++ == 0) start = row[0];
    const double samples = (row[0] - start) * table.configuration().sampling_rate;
    if (!(std::abs(samples - static_cast<double>(taken - 1)) < 0.5))
      throw std::runtime_error("line " + std::to_string(number) + ": a sample is missing, or the sampling is another");
    if (monitor.push(row.subspan(1), std::numeric_limits<double>::quiet_NaN()))
      report(table, monitor.features(), ++records);
  }
  if (records == 0) throw std::runtime_error("the input ended before one record was complete");
}

} // namespace

int main(int argc, char **argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: lacuna-onboard TABLE < RECORDING.csv");
    run(argv[1]);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "lacuna-onboard: %s\n", error.what());
    return 1;
  }
}
