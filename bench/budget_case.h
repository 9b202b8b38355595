#pragma once

#include <memory>
#include <string>

#include "solidnoise/noise/noise.h"

namespace solidnoise::bench {

// Isotropic Gabor noise in 3D within an error of 2 %, a voxel being a world unit.
struct BudgetCase {
  int impulses = 32;  // per kernel
  int radius = 16;    // of the kernel in voxels, that of the highest octave
  int octaves = 1;    // each of twice the frequency and half the amplitude of the one before it

  std::string name() const;  // such as gabor/3/isotropic/N32/R16x4

  std::shared_ptr<const Noise<3>> direct() const;        // every voxel summed, all of the error the kernel's
  std::shared_ptr<const Noise<3>> interpolated() const;  // the error split between kernel and interpolation

  friend bool operator==(const BudgetCase&, const BudgetCase&) = default;
};

}  // namespace solidnoise::bench
