#pragma once

#include "solidnoise/mesh/bake_mesh.h"

namespace solidnoise {

// What a bake takes: seconds of one core of 2023 (3 GHz, AVX-512) without other work beside it, and bytes at
// most, the program itself included.
struct BakeCost {
  double seconds = 0.0;
  double bytes = 0.0;
};

// Bytes that planning and baking take at most for a mesh of so many vertices and faces; a preview takes two
// thirds more (kPreviewMemory). The libraries that images are rendered and written by are kImageMemory.
double bake_memory(double vertices, double faces);
inline constexpr double kPreviewMemory = 5.0 / 3.0;
inline constexpr double kImageMemory = 128.0 * 0x1p20;

// Of a plan, from here to the file, without a preview.
BakeCost bake_cost(const BakePlan& plan, const BakeRecipe& recipe);

// And of a square picture of the mesh, of so many pixels a side.
BakeCost with_preview(const BakeCost& bake, int side);

}  // namespace solidnoise
