#pragma once

#include <cstdint>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {

// Parameters of Gabor noise made of isotropic kernels (every impulse the same, up to its weight).
struct GaborNoiseOptions {
  double frequency = 8.0;        // principal frequency F0, cycles per world unit; > 0
  double bandwidth = 1.0;        // width of the band at half amplitude, octaves; 0.05 to 4
  double error = 0.02;           // relative RMS error against the kernel of infinite support; 1e-4 to 0.5
  bool bounds_gradient = false;  // whether the gradient's error is within `error`, too, relative to itself
  double impulses =
      0.0;  // mean impulses under one kernel, N; 0: the fewest that look Gaussian, see the noise
  ImpulseSpread impulses_process = ImpulseSpread::strata;
  // Mean excess kurtosis that strata may leave, where their number of impulses is chosen; 0.02 to 0.5.
  double kurtosis = kMeanKurtosis;
  ImpulseWeights weights = ImpulseWeights::signs;
  std::uint64_t seed = 0;
  Vec<4> period{0.0};     // world units per axis (x, y, z, t); 0: none; else at least 2 kernel radii
  Evolution evolution{};  // how it changes with time; by default it does not
  double filter = 0.0;    // standard deviation of a Gaussian that it is convolved with, world units; 0: none

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const GaborNoiseOptions&, const GaborNoiseOptions&) = default;
};

// Parameters of Gabor noise made of oriented kernels with random phase.
struct OrientedGaborNoiseOptions {
  double frequency = 8.0;        // principal frequency F0, cycles per world unit; > 0
  double bandwidth = 1.0;        // width of the band at half amplitude, octaves; 0.05 to 4
  double error = 0.02;           // relative RMS error against the kernel of infinite support; 1e-4 to 0.5
  bool bounds_gradient = false;  // whether the gradient's error is within `error`, too, relative to itself
  double impulses =
      0.0;  // mean impulses under one kernel, N; 0: the fewest that look Gaussian, see the noise
  ImpulseSpread impulses_process = ImpulseSpread::strata;
  // Mean excess kurtosis that strata may leave, where their number of impulses is chosen; 0.02 to 0.5.
  double kurtosis = kMeanKurtosis;
  double anisotropy = 0.0;  // 0: directions uniform on the sphere; 1: all along `direction`; 0 to 1
  Vec<4> direction{1.0, 0.0, 0.0, 0.0};  // along which the waves travel; any length but 0
  std::uint64_t seed = 0;
  Vec<4> period{0.0};     // world units per axis (x, y, z, t); 0: none; else at least 2 kernel radii
  Evolution evolution{};  // how it changes with time; by default it does not
  double filter = 0.0;    // standard deviation of a Gaussian that it is convolved with, world units; 0: none

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const OrientedGaborNoiseOptions&, const OrientedGaborNoiseOptions&) = default;
};

}  // namespace solidnoise
