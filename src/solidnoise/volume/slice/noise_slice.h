#pragma once

#include <utility>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/slice/slice_plane.h"
#include "solidnoise/volume/slice/slice_source.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// A noise on a plane: what its pixels have values of, and what is known of them.
struct NoiseSlice {
  SliceSourcePtr source;
  double sigma = 0.0;  // of the noise, in closed form

  // The values that are black and white in a picture: 3 standard deviations to each side, or the range's
  // ends.
  std::pair<double, double> shown;
};

// Whether a short form is of a noise alone, or of three for its colours, in all of space.
bool is_noise_alone(const VolumeRecipe& recipe);

// The noise of a short form whose shaping is RawShaping: of its dimensions 3 or 4, evaluated at fewer places
// and interpolated where the pixels hold it with room to spare, within the recipe's error; not where it is
// `exact`. Of a recipe with band_limit take it at_resolution().
NoiseSlice make_noise_slice(const VolumeRecipe& recipe, const SlicePlane& plane);

// The same of a noise on the line, or on the plane: `recipe.dims` is 1 or 2. It varies along x, or along x
// and y, and is constant along the other axes.
NoiseSlice make_flat_slice(const VolumeRecipe& recipe, const SlicePlane& plane);

// Of the slice's values, what a filter leaves of 1, or 1 where they are normalized.
double variance_of(const VolumeRecipe& recipe, const NoiseSlice& slice);

// The upper end of the band of its noise, of any dimensions, cycles per world unit.
double highest_frequency_in_slice(const VolumeRecipe& recipe);

// After how many world units along a direction of the plane the noise repeats; 0 if it does not, or if the
// direction is none of its axes.
double period_along(const Vec<3>& direction, const NoiseRecipe& noise);

}  // namespace solidnoise
