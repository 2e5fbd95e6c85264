// onboard_speed SECONDS: processor seconds that the on-board chain takes for a stream of that many seconds.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "lacuna/chain.hpp"
#include "lacuna/onboard/monitor.hpp"
#include "paper.hpp"
#include "reference_actuator.h"

namespace {

constexpr int ROWS = 100000; // one second at the paper's sampling rate

std::vector<std::array<double, 5>> one_second() {
  reference_parameters parameters = reference_defaults();
  parameters.zeta = 0.2;
  std::vector<std::array<double, 5>> rows(ROWS);
  reference_simulate(&parameters, 1.0 / ROWS, ROWS, reinterpret_cast<double(*)[5]>(rows.data()));
  return rows;
}

lacuna::Configuration of_paper() {
  const lacuna::Chain chain(paper_settings());
  const auto &s = chain.settings();
  return {s.currents.size(), s.samples(),  chain.sections().length(), chain.sections().hop(), chain.spectrum().padded(),
          s.sampling_rate,   s.peak_above, s.peak_threshold,          s.speed_after};
}

} // namespace

int main(int count, char **arguments) {
  const int seconds = count == 2 ? std::atoi(arguments[1]) : 0;
  if (seconds < 1) {
    std::fprintf(stderr, "usage: onboard_speed SECONDS\n");
    return 2;
  }
  const auto rows = one_second();
  lacuna::onboard::Monitor monitor(of_paper());
  const std::clock_t begin = std::clock(); // of this process: other work on the machine does not count
  for (int second = 0; second < seconds; ++second)
    for (const auto &row : rows)
      monitor.push({row.data(), 3}, row[4]);
  std::printf("%.6f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return 0;
}
