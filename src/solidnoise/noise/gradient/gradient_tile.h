#pragma once

#include <cstdint>

#include "solidnoise/noise/convolution/impulse_sums.h"

namespace solidnoise {

// How the vectorised sums of gradient noise see the axes of a block. Vectors hold `mid` by `fast` samples; a
// vector's work is repeated along `slow`; `outer` is the axis of time in 4D. The roles that a noise has:
// 1D: fast; 2D: slow, fast; 3D: slow, mid, fast; 4D: outer, slow, mid, fast, for t, x, y, z. Others stay 0.
enum GradientRole { kOuter, kSlow, kMid, kFast };
inline constexpr int kGradientRoles = 4;
static_assert(kGradientRoles == kRoles);

// The axis that has a role in Dim dimensions, or -1.
template <int Dim>
constexpr int axis_of_gradient_role(int role) {
  if (role == kFast) return Dim >= 3 ? 2 : Dim - 1;
  if (role == kMid) return Dim >= 3 ? 1 : -1;
  if (role == kSlow) return Dim >= 2 ? 0 : -1;
  return Dim == 4 ? 3 : -1;
}

// The role that an axis has.
template <int Dim>
constexpr int gradient_role(int axis) {
  int role = 0;
  while (axis_of_gradient_role<Dim>(role) != axis) ++role;
  return role;
}

// What a gradient noise is to the sums. Lengths are in units of the kernel's radius, so that a term is
//   t^4 (t - root) (gradient . offset),  t = 1 - |offset|^2, 0 where t < 0.
struct GradientSum {
  int dimensions = 3;
  float spacing = 0.5f;                   // of the lattice points
  float root = 0.75f;                     // c2 / c1
  const float (*gradients)[4] = nullptr;  // per gradient and role, with the noise's amplitude
};

// Lattice points that may reach the samples: `rows` along each role from coordinate `first`, and the indices
// of their gradients.
struct GradientRows {
  float first[kGradientRoles] = {};
  int rows[kGradientRoles] = {1, 1, 1, 1};
  int stride[kGradientRoles] = {};
  const std::uint8_t* gradient_index = nullptr;
};

// A tile of samples: 2 x 2 x 2 groups (slow, mid, fast) of 4 slow samples by a vector of 16. Coordinates are
// relative to some lattice point near by, exact in single precision. Unused entries repeat the last used one.
struct GradientTile {
  static constexpr int kSlow = 4;
  static constexpr int kLanes = 16;
  static constexpr int kGroupSamples = kSlow * kLanes;
  static constexpr int kSamples = 8 * kGroupSamples;
  static constexpr int kMaxRows = 10;

  alignas(64) float mid[2][kLanes] = {};
  alignas(64) float fast[2][kLanes] = {};
  alignas(64) float slow[2][kSlow] = {};
  float outer = 0.0f;
  int groups[kGradientRoles] = {1, 1, 1, 1};
  GradientRows lattice;

  static constexpr int group_index(int slow, int mid, int fast) { return (slow * 2 + mid) * 2 + fast; }
};

// Up to 16 samples of one lattice cell, anywhere in it, in radii.
struct GradientCluster : SampleCluster {
  GradientRows lattice;
};

// Values, and derivatives along each role with respect to lengths in radii. A tile's sample is at
// group_index * kGroupSamples + slow * kLanes + lane.
using GradientTileSums = Sums<GradientTile::kSamples>;

// The sums over lattice points, by the widest instruction set that the processor has. Terms are added in the
// lexicographic order of (t, x, y, z), elementwise, and points out of reach add exactly 0, so that a sample's
// value does not depend on the tile or cluster it is in, nor on the vector width. Only used groups and
// samples are written.
void sum_gradient_noise(const GradientSum& sum, const GradientTile& tile, Derivatives derivatives,
                        GradientTileSums& sums);
void sum_gradient_noise(const GradientSum& sum, const GradientCluster& cluster, Derivatives derivatives,
                        ClusterSums& sums);

}  // namespace solidnoise
