#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "blocks.h"

namespace solidnoise::bench {

// A different block for each iteration, in the order in which a volume's blocks are filled.
template <int Dim>
Index<Dim> block_corner(std::int64_t iteration, int thread, int side = kBlock) {
  Index<Dim> corner(0);
  corner[0] = side * (iteration / 64);
  corner[1] = side * (iteration / 8 % 8);
  corner[2] = side * (iteration % 8 + 8 * thread);
  return corner;
}

// What of a noise is evaluated.
enum class Evaluated { values, values_and_gradient, gradient };

template <int Dim>
void evaluate_blocks(benchmark::State& state, const Noise<Dim>& noise, int side = kBlock,
                     Evaluated evaluated = Evaluated::values) {
  constexpr std::size_t kVoxels = kLeaf * kLeaf * kLeaf;
  std::vector<float> memory((1 + Dim) * kVoxels);
  Samples<Dim> samples{std::span(memory).first(kVoxels), {}, evaluated == Evaluated::gradient};
  for (std::size_t axis = 0; evaluated != Evaluated::values && axis < Dim; ++axis) {
    samples.gradient[axis] = std::span(memory).subspan((1 + axis) * kVoxels, kVoxels);
  }
  std::int64_t iteration = 0;
  for (auto _ : state) {
    evaluate_block(noise, block_corner<Dim>(iteration++, state.thread_index(), side), side, samples, [&] {
      benchmark::DoNotOptimize(memory.data());
      benchmark::ClobberMemory();
    });
  }
  state.SetItemsProcessed(state.iterations() * side * side * side);
}

}  // namespace solidnoise::bench
