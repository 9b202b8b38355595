#pragma once

#include <cstdint>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/noise/point/scale_transition.h"

namespace solidnoise {

// Parameters of Gabor noise whose parameters may vary from place to place: what holds where nothing else is
// given.
struct VaryingGaborOptions {
  double frequency = 8.0;  // principal frequency F0, cycles per world unit; > 0
  double bandwidth = 1.0;  // width of the band at half amplitude, octaves; 0.1 to 4
  double error = 0.02;     // relative RMS error against the kernel of infinite support; 1e-4 to 0.5
  double impulses = 0.0;   // mean impulses under one kernel, N; 0: the fewest with excess kurtosis below 0.5
  GaborWaves waves = GaborWaves::isotropic;
  Vec<4> direction{1.0, 0.0, 0.0, 0.0};                // of oriented waves, the first axes of it; any length
  ScaleTransition transition = ScaleTransition::fade;  // where the frequency or bandwidth varies
  std::uint64_t seed = 0;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const VaryingGaborOptions&, const VaryingGaborOptions&) = default;
};

}  // namespace solidnoise
