#pragma once

#include <memory>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/noise_recipe.h"
#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/field/point_field.h"
#include "solidnoise/volume/parameters/parameter_fields.h"

namespace solidnoise {

// Where a noise with varying parameters is looked at.
struct NoiseView {
  int dims = 3;        // 3, or 4: of a frame of VaryingGaborNoise<4>
  double time = 0.0;   // of the frame
  Vec<3> offset{0.0};  // moves the noise, but not its parameters; world units
};

// The noise of a recipe, with the kernels that the fields of frequency, bandwidth and direction give it at
// each position (VaryingGaborNoise): octave k has the frequency there times lacunarity^k. The variance is 1
// everywhere, or that of the recipe's octaves where they are not renormalised. Waves of gabor-oriented noise
// travel as the field of the direction says, in space only where the noise is of 4 dimensions; of anisotropy
// 0, that is in all directions, they become the isotropic kernels of gabor noise.
//
// On a lattice positions are rounded to 2^-16 of a voxel, so that values depend on nothing else; many
// lattices at once (FieldBlock::evaluate_all) are far cheaper than one by one, for they share impulses.
// Evaluation throws what the fields do.
class VaryingField : public Field, public PointField {
 public:
  virtual double variance() const = 0;

  // Of the noise with the recipe's own parameters everywhere.
  virtual double excess_kurtosis() const = 0;

  // From that of the least frequency and the widest bandwidth to that of the greatest and the widest.
  virtual Noise<3>::Band band() const = 0;
};

// Throws std::invalid_argument as ParameterGrids::validate() does.
std::shared_ptr<const VaryingField> make_varying_field(const NoiseRecipe& recipe, const NoiseView& view,
                                                       std::shared_ptr<const ParameterFields> fields);

// Octave k of it by itself, of unit variance.
std::shared_ptr<const VaryingField> make_varying_octave(const NoiseRecipe& recipe, int k,
                                                        const NoiseView& view,
                                                        std::shared_ptr<const ParameterFields> fields);

}  // namespace solidnoise
