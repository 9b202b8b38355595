#pragma once

#include <array>

#include "solidnoise/noise/convolution/impulse_list.h"

namespace solidnoise {

// Up to 8 x 8 x 8 samples on a regular lattice (an OpenVDB leaf), at one time: coordinates per role in cells
// from the anchor cell's corner, exact. Unused entries repeat the last used one.
struct SampleBrick {
  static constexpr int kSide = 8;
  static constexpr int kSamples = kSide * kSide * kSide;

  alignas(64) float coordinate[3][kSide] = {};
  float time = 0.0f;
  std::array<int, 3> count{1, 1, 1};
};

// Up to 16 scattered samples, likewise.
struct SampleCluster {
  static constexpr int kSamples = 16;

  alignas(64) float coordinate[kRoles][kSamples] = {};
  int count = 0;
};

// Sums of a brick (sample (x, y, z) at (x * 8 + y) * 8 + z) or of a cluster, before the noise's amplitude is
// applied; gradients are with respect to offsets in radii of the support.
template <int kSamples>
struct Sums {
  alignas(64) float value[kSamples];
  alignas(64) float gradient[kRoles][kSamples];
};
using BrickSums = Sums<SampleBrick::kSamples>;
using ClusterSums = Sums<SampleCluster::kSamples>;

enum class Derivatives { none, gradient };

}  // namespace solidnoise
