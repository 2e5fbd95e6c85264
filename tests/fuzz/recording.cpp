// Any text as settings and as a recording: read, or refused by lacuna::Error.
#include <cmath>
#include <sstream>

#include "bytes.hpp"
#include "lacuna/error.hpp"
#include "lacuna/recording.hpp"
#include "lacuna/settings.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  Bytes bytes(data, size);
  const auto kind = bytes.next<std::uint8_t>();
  const auto samples = bytes.next<std::uint8_t>();
  try {
    if (kind % 2) {
      const auto settings = lacuna::Settings::parse(bytes.rest());
      require(settings.sampling_rate > 0 && !settings.currents.empty(), "settings that are taken can be used");
    } else {
      std::istringstream csv(bytes.rest());
      const auto recording = lacuna::Recording::read(csv, {"i"}, "phi", 10.0, samples);
      require(recording.column(0).size() == samples, "as many samples as were asked for");
    }
  } catch (const lacuna::Error &) {
  }
  return 0;
}
