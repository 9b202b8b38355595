#pragma once

#include <memory>

#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The field of a recipe whose output is not the value alone; its channels are those of the outputs, in their
// order. Vectors and colours take independent noises, channel_of(recipe.noise, 0), 1 and 2. Throws
// std::invalid_argument: what the recipe asks for is not possible.
std::unique_ptr<Field> make_derived_field(const VolumeRecipe& recipe, const VolumePlan& plan);

}  // namespace solidnoise
