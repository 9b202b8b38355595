#pragma once

#include <array>
#include <vector>

#include "solidnoise/noise/convolution/impulse_list.h"
#include "solidnoise/noise/convolution/sample_brick.h"

namespace solidnoise {

// The vectorised loops of sparse convolution: culling and summation. Each function runs the code of the
// widest instruction set that the processor has. Every sum is taken impulse by impulse in the list's order,
// elementwise per sample, so that its value does not depend on the vector width, the culling or the other
// samples.

// Appends to `list` the run's impulses whose support meets the box.
void cull_impulses(const ImpulseRun& run, const CullBox& box, ImpulseList& list);

// A radial function of compact support, w t^2 P(v) with t = 1 - s, v = t - 1/2 and s the squared distance in
// radii; 0 for s >= 1. The polynomials are in powers of v, or in Chebyshev polynomials of 2 v where powers
// would lose accuracy.
struct RadialPolynomial {
  enum class Basis { power, chebyshev };

  Basis basis = Basis::power;
  std::vector<float> value;       // coefficients of P, low to high
  std::vector<float> derivative;  // coefficients of dP/dv, in the same basis
};

// Sums of an isotropic kernel. Attribute 0 of the list is the impulse's weight.
struct RadialSum {
  std::array<float, kRoles> scale{};  // cells to radii; 0 for roles that the noise does not have
  RadialPolynomial kernel;
};
void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                Derivatives derivatives, BrickSums& sums);
void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                Derivatives derivatives, ClusterSums& sums);

// Sums of oriented kernels: cos(2 pi (w . d + phase)) times one envelope t^2 P(v) per axis, v = 1/2 - (d /
// H)^2. Attributes of the list: w along x, y and z in cycles per cell, the phase in cycles, w along t.
struct OrientedSum {
  static constexpr int kPhase = 3;  // attributes
  static constexpr int wave(Role role) { return role == kT ? kPhase + 1 : role; }

  std::array<float, kRoles> scale{};  // cells to half-widths H; 0 for roles that the noise does not have
  RadialPolynomial envelope;
};
void sum_oriented(const OrientedSum& sum, const ImpulseList& list, const SampleBrick& brick,
                  Derivatives derivatives, BrickSums& sums);
void sum_oriented(const OrientedSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                  Derivatives derivatives, ClusterSums& sums);

}  // namespace solidnoise
