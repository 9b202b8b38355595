#pragma once

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// The kernel that a noise of 3 or 4 dimensions is made of, on the plane of x and y through its middle, as far
// as its support reaches: that of the first octave, of phase 0 and along the axis where it is oriented, with
// a gradient along x where it is a gradient's.
DenseField<2> kernel_slice(const NoiseRecipe& recipe, int dims);

}  // namespace solidnoise
