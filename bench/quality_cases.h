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

namespace solidnoise::bench {

// Three generators of solid noise that look alike: rings in frequency of the same place and width (Kensler's
// noise has the middle four fifths of its variance within two thirds of an octave, as Gabor noise of 0.9
// octaves), and the same error of 2 % where kernels have one. 12 voxels per cell of Kensler's lattice. Gabor
// noises have the impulses of the default, whose values past 4 standard deviations are 0.9 (isotropic) and
// 1.25 times a Gaussian field's, or Poisson processes of 1.1 and 1.3 times, of an excess kurtosis of 0.01 and
// 0.03; Kensler's noise has 0.14 in absolute value.
enum class Generator { isotropic, directions, isotropic_poisson, directions_poisson, kensler };

// Of Gabor noises the whole error is the kernels', and every voxel is summed.
std::shared_ptr<const Noise<3>> equal_quality_direct(Generator generator);

// The error is split between kernels and interpolation. Kensler's noise is what it is.
std::shared_ptr<const Noise<3>> equal_quality_budget(Generator generator);

}  // namespace solidnoise::bench
