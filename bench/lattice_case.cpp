// lattice_case COUNT: evaluates a lattice of 128^3 samples so often, by a single thread, into memory that is
// new each time, and prints the seconds of each. overhead.py holds them against the same call from Python.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>

#include <tbb/task_arena.h>

#include "solidnoise/analysis/parallel_evaluation.h"
#include "solidnoise/noise/registry/noise_recipe.h"

int main(int argc, char** argv) {
  using namespace solidnoise;
  const int count = argc > 1 ? std::atoi(argv[1]) : 1;
  const auto noise =
      make_noise<3>({.noise = GaborNoiseOptions{.frequency = 4.0, .impulses = 32.0}, .fractal = {}});
  const Lattice<3> lattice{.step = Vec<3>(0.01), .count = {128, 128, 128}};
  tbb::task_arena arena(1);
  for (int i = 0; i < count; ++i) {
    const std::clock_t begin = std::clock();
    const auto values = std::make_unique_for_overwrite<float[]>(lattice.size());
    arena.execute([&] {
      evaluate_in_parallel<3>(*noise, lattice, Samples<3>{{values.get(), lattice.size()}, {}});
    });
    std::printf("%.6f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return 0;
}
