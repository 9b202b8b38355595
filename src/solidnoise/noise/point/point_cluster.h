#pragma once

#include "solidnoise/noise/convolution/impulse_sums.h"

namespace solidnoise {

// The vectorised loops of noises whose parameters belong to the evaluation points: lanes are points. Each sum
// is taken impulse by impulse in the list's order, elementwise per point, and impulses out of a point's reach
// add exactly 0, so that a point's value depends neither on the vector width nor on the other points. Lengths
// are in cells. Gradients are by the point's position, per cell, while all else that it has stays as it is,
// also its normal: of a layer's kernel they are to be taken along the surface.

// What an impulse carries: weight and turn, or the components of a gradient, or a wave along the surface.
enum PointAttribute {
  kWeight,  // 1 or -1
  kTurn,    // 2^-n + (1 - 2^-n) u of ScaleFade: its y divided by (r / 2^l)^n
  kGradientX = 0,
  kGradientY,
  kGradientZ,
  kWaveX = 0,  // cycles per cell along the points' tangents
  kWaveY,      // and across them
  kWaveWeight,
};
static_assert(kTurn == PointCull::kTurn);

// Up to 16 points and their kernels; unused lanes repeat a used one.
struct PointCluster : SampleCluster {
  alignas(64) float inverse_square_radius[kSamples];
  alignas(64) float density[kSamples];       // (r / 2^l)^n
  alignas(64) float wave[kRoles][kSamples];  // cycles per cell
  alignas(64) float normal[3][kSamples];     // of unit length
  alignas(64) float tangent[3][kSamples];    // of unit length, at a right angle to the normal
  alignas(64) float inverse_square_height[kSamples];
  Derivatives derivatives = Derivatives::none;  // that are wanted
};

// Coefficients of each point's polynomial, from degree 0, `kSamples` to a degree.
struct PointPolynomials {
  bool power = true;                    // P in powers of v; or t^2 P in Chebyshev polynomials of 2 v
  int degree = 0;                       // of the highest; even and at least 4 for powers
  const float* coefficients = nullptr;  // aligned to 64 bytes
};

// Which kernel is summed: w fade(y) t^4 P(t - 1/2) with t = 1 - |d|^2 / r^2, 0 where negative; d is the
// offset from the impulse;
//   oriented: times cos(2 pi wave . d);
//   layer:    |d| is the distance along the surface, d - (d . normal) normal, and there is another factor
//             h = (1 - (d . normal)^2 / H^2)^2, 0 for |d . normal| > H.
struct PointKernel {
  int dimensions = 3;  // or 4
  bool layer = false;  // in 3 dimensions only
  bool oriented = false;
  bool fade = false;  // fade(y) of ScaleFade; 1 otherwise
};
// `impulses` is padded by one if their number is odd, with one of weight 0.
void sum_impulses(const PointKernel& kernel, const PointCluster& cluster, const PointPolynomials& polynomials,
                  ImpulseList& impulses, ClusterSums& sums);

// Waves along a surface: with d = o n + x u + y (n cross u) the offset split along the normal and the
// tangents, the sum of
//   weight t^4 P(t - 1/2) cos(2 pi (wave x . x + wave y . y)) (1 - o^2 / H^2)^2,   t = 1 - (x^2 + y^2) / r^2,
// 0 where t or the last factor's base are negative.
struct LayerWaveKernel {
  RadialPolynomial envelope;  // in Chebyshev polynomials; two at least
};
// Of the cluster it takes coordinates, normals, tangents and inverse squares.
void sum_layer_waves(const LayerWaveKernel& kernel, const PointCluster& cluster, const ImpulseList& impulses,
                     ClusterSums& sums);

// Gradient noise projected on surfaces: impulses are lattice points with gradients G, and with d = o n + A
// the offset split along the normal and along the surface, the kernel is
//   (A . G) t^4 (t - root) (3 x^2 - 2 x^3),  t = 1 - |A|^2 / r^2,  x = 1 - |o| / height, 0 where negative.
struct ProjectedKernel {
  float root = 0.75f;
};
// Of the cluster it takes coordinates, normals and inverse squares; the same for all lanes.
void sum_projected(const ProjectedKernel& kernel, const PointCluster& cluster, const ImpulseList& impulses,
                   ClusterSums& sums);

}  // namespace solidnoise
