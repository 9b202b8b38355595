#pragma once

#include <ctime>

namespace solidnoise::papers {

// Seconds of the processor that the quickest of some runs takes, of one thread: other programs that run at
// the time matter less than to the time on the wall.
template <typename Run>
double quickest(int runs, const Run& run) {
  double best = 0.0;
  for (int i = 0; i < runs; ++i) {
    const std::clock_t begin = std::clock();
    run();
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (i == 0 || seconds < best) best = seconds;
  }
  return best;
}

}  // namespace solidnoise::papers
