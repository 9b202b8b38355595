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

// A radial function of compact support, w t^2 P(t) with t = 1 - s and s the squared distance in radii; 0 for
// s >= 1.
struct RadialPolynomial {
  enum class Form { factored, chebyshev };

  Form form = Form::factored;
  float leading = 1.0f;      // a factor of P
  std::vector<float> value;  // coefficients: of a FactoredPolynomial, or in Chebyshev polynomials of 2 t - 1
  std::vector<float> derivative;  // in Chebyshev polynomials: of dP/dt; else not used
};

// Up to where a sum takes factored polynomials: the degrees that it is compiled for, and what rounding may
// add to a kernel, relative RMS.
struct FactoredLimits {
  int degree;
  double rounding;
};

// Sums of an isotropic kernel. Attribute 0 of the list is the impulse's weight.
struct RadialSum {
  static constexpr FactoredLimits kFactored{12, 1e-5};

  std::array<float, kRoles> scale{};  // cells to radii; 0 for roles that the noise does not have
  RadialPolynomial kernel;
};
void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleBrick& brick,
                Derivatives derivatives, BrickSums& sums);
void sum_radial(const RadialSum& sum, const ImpulseList& list, const SampleCluster& cluster,
                Derivatives derivatives, ClusterSums& sums);

// Sums of oriented kernels: cos(2 pi (w . d + phase)) times one envelope t^2 P(t) per axis, t = 1 - (d /
// H)^2. Attributes of the list: w along x, y and z in cycles per cell, the phase in cycles, w along t.
struct OrientedSum {
  static constexpr FactoredLimits kFactored{6, 1e-6};
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
