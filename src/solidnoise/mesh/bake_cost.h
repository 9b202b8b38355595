#pragma once

#include "solidnoise/core/cost.h"
#include "solidnoise/mesh/bake_mesh.h"

namespace solidnoise {

// Bytes that planning and baking take at most for a mesh of so many vertices and faces; a preview takes two
// thirds more (kPreviewMemory). The libraries that images are rendered and written by are kImageMemory.
double bake_memory(double vertices, double faces);
// And what smoothing takes besides, for a vertex of the mesh before it is refined.
double smoothing_memory(const BakeRecipe& recipe);
inline constexpr double kPreviewMemory = 5.0 / 3.0;
inline constexpr double kImageMemory = 128.0 * 0x1p20;

// Of a plan, from here to the file, without a preview, with the program itself.
Cost bake_cost(const BakePlan& plan, const BakeRecipe& recipe);

// And of a square picture of the mesh, of so many pixels a side.
Cost with_preview(const Cost& bake, int side);

}  // namespace solidnoise
