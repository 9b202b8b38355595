#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe.h"

namespace solidnoise {

// What is to be made of a recipe at the vertices of a plan, beside the noise.
struct BakeWishes {
  bool colors = false;
  std::vector<std::string> properties{};  // of the recipe, by name
  bool slopes = false;
  bool bounds_gradient = false;  // of slopes, as bake_slopes() has it
};

struct BakedValues {
  std::vector<float> noise;                    // times magnitude plus bias
  std::vector<Color> colors;                   // in linear light
  std::vector<std::vector<float>> properties;  // in the order of the wishes
  // Of the height, per world unit, along the surface: of the property of that name, or of the noise where
  // there is none.
  std::vector<Vec<3>> slopes;
};

// Evaluates the recipe at the plan's vertices, which need no faces, in parallel. Throws std::invalid_argument
// for a property that is not the recipe's; Cancelled.
BakedValues bake_values(const BakePlan& plan, const BakeRecipe& recipe, const BakeWishes& wishes,
                        Progress* progress = nullptr);

}  // namespace solidnoise
