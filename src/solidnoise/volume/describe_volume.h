#pragma once

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What a recipe, or a part of it, would make, without making it: kernel, statistics in closed form, voxels,
// memory. Throws what plan_volume() does.
Json describe_volume(const VolumeRecipe& recipe, const VolumePart& part = {});

}  // namespace solidnoise
