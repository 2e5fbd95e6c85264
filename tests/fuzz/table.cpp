// Any table behind a right checksum; where it is taken, its monitor and its estimates are, too.
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "bytes.hpp"
#include "lacuna/onboard/monitor.hpp"
#include "lacuna/severity_table.hpp"

namespace {

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = ~0U;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      crc = crc >> 1 ^ (crc & 1U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

void use(const lacuna::SeverityTable &table) {
  const lacuna::Configuration &c = table.configuration();
  std::vector<double> signature(lacuna::signature_size(c.channels));
  for (const double level : {0.0, 1.0, 1e300}) {
    signature.assign(signature.size(), level);
    const lacuna::Estimate found = table.estimate(signature, level);
    require(found.band < table.bands().size(), "the band is one of the table's");
    require(!found.covered || (std::isfinite(found.severity) && found.low <= found.high),
            "a covered record has a severity and its interval");
  }
  if (c.samples > 4096 || c.padded > 4096) return; // memory and time, within what the table may ask for
  lacuna::onboard::Monitor monitor(c);
  const std::array<double, lacuna::max_channels> currents{1, -1, 0.5, 0, 2, -2};
  for (std::size_t k = 0; k < c.samples; ++k)
    monitor.push({currents.data(), c.channels}, 0.1 * static_cast<double>(k));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  std::vector<std::uint8_t> file(data, data + size);
  const std::uint32_t sum = crc32(file);
  for (int k = 0; k < 4; ++k)
    file.push_back(static_cast<std::uint8_t>(sum >> 8 * k));
  try {
    use(lacuna::SeverityTable(std::as_bytes(std::span(file))));
  } catch (const std::runtime_error &) {
  } catch (const std::invalid_argument &) {
  }
  return 0;
}
