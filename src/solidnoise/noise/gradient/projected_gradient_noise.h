#pragma once

#include <cstdint>
#include <memory>

#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/gradient/gradient_kernel.h"
#include "solidnoise/noise/gradient/gradient_lattice.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/point/point_parameters.h"

namespace solidnoise {

// Parameters of Kensler's gradient noise projected on surfaces (Kensler, Knoll, Shirley 2008, section 4).
struct ProjectedGradientOptions {
  double frequency = 8.0;  // frequency at which the radial power on a plane peaks, cycles per world unit; > 0
  std::uint64_t seed = 0;
  Evolution evolution{};  // at time 0 the noise is the one that stands still

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const ProjectedGradientOptions&, const ProjectedGradientOptions&) = default;
};

// Kensler's gradient noise on surfaces (Kensler, Knoll, Shirley 2008, section 4): lattice points are
// projected on the tangent plane of the point x with unit normal n,
//   noise(x, n) = sum over lattice points i of window(|o|) s(|A|) A.G_i,   o = (x - i).n,   A = x - i - o n,
//   window(u) = 3 (1 - u)^2 - 2 (1 - u)^3, 0 for u >= 1,
// with the unit gradients G_i and s of GradientKernel as published, lengths in lattice units.
//
// On a plane the spectrum, averaged over positions, is that of the two-dimensional noise. The variance
// averaged over positions is, by C = 26/35 the integral of the window's square over |o| < 1,
//   mean variance = (C/3) 2 pi integral of r^3 s(r)^2 dr = C (2/3) (mean variance of the 2D noise):
// .0377172. Values are scaled to a mean variance of 1. It is not stationary: at a point it depends on
// position and normal.
//
// Differences from the paper: all lattice points in reach are summed (its stencil of 4^3 leaves out 0.8 % of
// them, those beyond a distance of 2, and values jump by up to 2.7e-4); no half resolution, in which a plane
// between two layers of the coarser lattice is 0 by the printed window; gradients as in GradientNoise.
//
// A value depends on the point's position and normal only, not on the other points (vector widths without
// fused multiply-add may differ in the last bits). Immutable; may be shared between threads.
class ProjectedGradientNoise {
 public:
  // Throws std::invalid_argument: options.validate().
  explicit ProjectedGradientNoise(const ProjectedGradientOptions& options);

  const ProjectedGradientOptions& options() const { return options_; }
  double lattice_spacing() const { return spacing_; }  // one lattice unit, in world units
  // Mean variance before scaling, in lattice units and for unit gradients.
  double lattice_variance() const { return lattice_variance_; }

  // One sample per point; the gradient is the part along the surface of the derivative by the position, with
  // the normal held fixed. Throws SurfacePoints::validate().
  void evaluate(const SurfacePoints& points, const Samples<3>& samples) const;

  double variance() const { return 1.0; }  // mean over positions
  // On a plane, averaged over positions: the frequencies that hold all but a thousandth of the variance.
  Noise<2>::Band band() const;

 private:
  ProjectedGradientOptions options_;
  GradientKernel<2> kernel_{GradientNoiseOptions::Kernel::kensler};
  double spacing_ = 1.0;
  double lattice_variance_ = 1.0;
  std::shared_ptr<const GradientLattice<3>> lattice_;
};

}  // namespace solidnoise
