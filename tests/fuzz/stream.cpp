// Any configuration and any samples through the on-board monitor: what it calls valid is finite.
#include <cmath>
#include <stdexcept>

#include "bytes.hpp"
#include "lacuna/onboard/monitor.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  Bytes bytes(data, size);
  lacuna::Configuration c{};
  c.channels = bytes.next<std::uint8_t>() % 4;
  c.samples = bytes.next<std::uint8_t>();
  c.section = bytes.next<std::uint8_t>();
  c.hop = bytes.next<std::uint8_t>();
  c.padded = std::size_t{1} << (bytes.next<std::uint8_t>() % 10);
  c.sampling_rate = bytes.next<double>();
  c.peak_above = bytes.next<double>();
  c.peak_threshold = bytes.next<double>();
  c.speed_after = bytes.next<double>();
  try {
    lacuna::onboard::Monitor monitor(c);
    while (bytes.left()) {
      double currents[lacuna::max_channels] = {};
      for (std::size_t k = 0; k < c.channels; ++k)
        currents[k] = bytes.next<double>();
      if (!monitor.push({currents, c.channels}, bytes.next<double>())) continue;
      const auto &found = monitor.features();
      if (!found.valid) continue;
      require(std::isfinite(found.rms_mean), "a valid record has a finite mean RMS");
      require(found.speed.turns == 0 || std::isfinite(found.speed.value), "a speed over turns is finite");
    }
  } catch (const std::invalid_argument &) {
  }
  return 0;
}
