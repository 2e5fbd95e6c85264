// onboard_speed SECONDS: processor seconds that the on-board chain takes for a stream of that many seconds.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "paper_stream.hpp"

int main(int count, char **arguments) {
  const int seconds = count == 2 ? std::atoi(arguments[1]) : 0;
  if (seconds < 1) {
    std::fprintf(stderr, "usage: onboard_speed SECONDS\n");
    return 2;
  }
  const auto rows = simulated(0.2, 100000); // one second
  lacuna::onboard::Monitor monitor(configuration_of(lacuna::Chain(paper_settings())));
  const std::clock_t begin = std::clock(); // of this process: other work on the machine does not count
  for (int second = 0; second < seconds; ++second)
    for (const auto &row : rows)
      monitor.push({row.data(), 3}, row[4]);
  std::printf("%.6f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return 0;
}
