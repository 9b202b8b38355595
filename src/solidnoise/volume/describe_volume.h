#pragma once

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "solidnoise/volume/volume_cost.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What a recipe, or a part of it, would make, without making it: kernel, statistics in closed form, voxels,
// memory. The cost is that of the way in which plan_making() has it made. Throws what plan_volume() does.
struct DescribeOptions {
  VolumePart part{};
  double memory = 0.0;  // bytes that may be taken; 0: any number
  Target target = Target::file;
  Progress* progress = nullptr;
};
Json describe_volume(const VolumeRecipe& recipe, const DescribeOptions& options = {});

}  // namespace solidnoise
