#pragma once

#include <vector>

#include "ratio_reporter.h"

namespace solidnoise::bench {

// Registers the benchmarks of noises at scattered points, the vertices of a mesh, and adds what to compare.
void add_scattered(std::vector<Ratio>& ratios);

}  // namespace solidnoise::bench
