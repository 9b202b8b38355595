#pragma once

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// Where a noise with varying parameters is looked at.
struct NoiseView {
  int dims = 3;        // 3, or 4: of a frame of VaryingGaborNoise<4>
  double time = 0.0;   // of the frame
  Vec<3> offset{0.0};  // moves the noise, but not its parameters; world units
};

// A parameter that varies: a field of one channel, and what its values are from and to.
struct VaryingParameter {
  FieldPtr field;  // null: the noise's own parameter holds everywhere
  double least = 0.0;
  double greatest = 0.0;

  explicit operator bool() const { return field != nullptr; }
};

// Of the kernels of a noise.
struct KernelFields {
  VaryingParameter frequency;  // of the first octave, cycles per world unit
  VaryingParameter bandwidth;  // octaves
  FieldPtr direction;          // three channels, of any length but 0; null: the noise's own
  double unit = 1.0;           // VaryingGaborOptions::unit
};

// The noise of a recipe, with the kernels that the fields give it at each position (VaryingGaborNoise):
// octave k has the frequency there times lacunarity^k. The variance is 1 everywhere, or that of the recipe's
// octaves where they are not renormalised; the excess kurtosis is that of the noise with the recipe's own
// parameters, and the band is from that of the least frequency and the widest bandwidth to that of the
// greatest and the widest. Waves of gabor-oriented noise travel as the direction says, in space only where
// the noise is of 4 dimensions; of anisotropy 0, that is in all directions, they become the isotropic kernels
// of gabor noise.
//
// The gradient holds the fields' values at the position fixed (VaryingGaborNoise).
//
// Many lattices at once (FieldBlock::evaluate_all) are far cheaper than one by one, for they share impulses.
// Evaluation throws what the fields do. Precondition: the recipe's noise is one that can vary. Throws
// std::invalid_argument as NoiseRecipe::validate() does.
FieldPtr make_varying_field(const NoiseRecipe& recipe, const NoiseView& view, const KernelFields& fields);

// Octave k of it by itself, of unit variance.
FieldPtr make_varying_octave(const NoiseRecipe& recipe, int k, const NoiseView& view,
                             const KernelFields& fields);

}  // namespace solidnoise
