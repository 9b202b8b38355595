#pragma once

#include <cstdint>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/noise/point/scale_transition.h"

namespace solidnoise {

// Parameters of Gabor noise on surfaces.
struct SurfaceGaborOptions {
  double frequency = 8.0;  // principal frequency F0, cycles per world unit; > 0
  double bandwidth = 1.0;  // width of the band at half amplitude, octaves; 0.1 to 4
  double error = 0.02;     // relative RMS error against the kernel of infinite support; 1e-4 to 0.5
  double impulses = 0.0;   // mean impulses under one kernel, N; 0: the fewest with excess kurtosis below 0.5
  GaborWaves waves = GaborWaves::isotropic;
  Vec<3> direction{1.0, 0.0, 0.0};  // of oriented waves, laid into the tangent plane; any length but 0
  // Half the thickness of the layer that impulses are taken from, in kernel radii; 0.1 to 1. A pattern is
  // distorted by curvature in proportion to the layer's thickness over the radius of curvature, and impulses
  // are made in inverse proportion to it.
  double layer = 0.5;
  ScaleTransition transition = ScaleTransition::fade;  // where the frequency or bandwidth varies
  std::uint64_t seed = 0;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const SurfaceGaborOptions&, const SurfaceGaborOptions&) = default;
};

}  // namespace solidnoise
