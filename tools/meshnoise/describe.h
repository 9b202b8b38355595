#pragma once

#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// What a bake would make: mesh, parameters, steering, recipe. Lengths in world units, frequencies in cycles
// per world unit.
Json describe_bake(const BakePlan& plan, const BakeRecipe& recipe);

}  // namespace solidnoise
