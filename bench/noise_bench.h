#pragma once

#include <vector>

#include "ratio_reporter.h"

namespace solidnoise::bench {

// Registers the benchmarks of noises at scattered points, the vertices of a mesh, and adds what to compare.
void add_scattered(std::vector<Ratio>& ratios);

}  // namespace solidnoise::bench

namespace solidnoise::bench {

// Registers the benchmarks of noise at one quality: within an error, and of several generators.
void add_budgets(std::vector<Ratio>& ratios);
void add_equal_quality(std::vector<Ratio>& ratios);

}  // namespace solidnoise::bench
