#pragma once

#include <cstdint>

#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// The noises that a surface can have, none of which needs a parametrisation.
enum class SurfaceNoiseKind {
  surface,        // Gabor noise of the tangent plane (SurfaceGaborNoise): a true two-dimensional band
  oriented,       // the same with waves that travel along a direction of the tangent plane
  solid,          // isotropic Gabor noise of space, the field that volumes have (GaborNoise<3>)
  kensler,        // gradient noise projected on the tangent plane (ProjectedGradientNoise)
  kensler_solid,  // gradient noise of space (GradientNoise<3>)
  spectrum,  // by example: in the tangent plane along a direction (SurfaceSpectrumNoise), or, of an exemplar
             // in three dimensions, the field of space (SpectrumNoise<3>)
};

// Everything that defines a noise on a surface but the frequency and what varies with the vertex: plain data.
struct SurfaceNoiseRecipe {
  SurfaceNoiseKind kind = SurfaceNoiseKind::surface;
  double error = 0.02;    // relative RMS error of Gabor kernels; 1e-4 to 0.5
  double impulses = 0.0;  // mean impulses under a Gabor kernel; 0: the fewest with excess kurtosis below 0.5
  double layer = 0.5;     // of surface and oriented: half the layer's thickness, in kernel radii; 0.1 to 1
  FractalOptions fractal;
  std::uint64_t seed = 0;
  ExemplarModel exemplar{};  // of spectrum
  int channel = 0;           // of the exemplar, that is baked; from 0

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const SurfaceNoiseRecipe&, const SurfaceNoiseRecipe&) = default;
};

// Whether frequency and bandwidth may differ from vertex to vertex.
bool may_vary(SurfaceNoiseKind kind);
// Whether there is an error and a number of impulses; and also a bandwidth.
bool is_gabor(SurfaceNoiseKind kind);
bool has_bandwidth(SurfaceNoiseKind kind);
// Whether impulses are taken from a layer around the surface.
bool has_layer(const SurfaceNoiseRecipe& recipe);
// Whether the noise lies along a direction of the tangent plane.
bool has_direction(const SurfaceNoiseRecipe& recipe);

// The noise of another channel of the exemplar, which is independent.
SurfaceNoiseRecipe channel_of(const SurfaceNoiseRecipe& recipe, int channel);

}  // namespace solidnoise
