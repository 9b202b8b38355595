#pragma once

#include <array>

#include "solidnoise/noise/convolution/impulse_sums.h"

namespace solidnoise {

// The vectorised loops of cellular noise: the distances F1 and F2 of samples to the nearest and second
// nearest of a list of impulses, in radii, 1 where none is nearer; `lift` is added. Only impulses that may be
// one of the two of some sample are looked at, and a sample's value depends neither on them nor on the other
// samples.
struct NearestDistance {
  int dimensions = 3;
  std::array<float, kRoles> scale{};  // cells to radii; 0 for roles that the noise does not have
  bool border = false;                // F2 - F1, else F1
  float lift = 0.0f;
};
void find_nearest(const NearestDistance& nearest, const ImpulseList& list, const SampleBrick& brick,
                  Derivatives derivatives, BrickSums& distances);
void find_nearest(const NearestDistance& nearest, const ImpulseList& list, const SampleCluster& cluster,
                  Derivatives derivatives, ClusterSums& distances);

}  // namespace solidnoise
