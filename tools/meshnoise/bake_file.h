#pragma once

#include "meshnoise/bake_arguments.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// Reads the mesh of a frame and plans its bake, within the memory and time that are allowed. Throws
// std::runtime_error.
BakePlan plan_frame(const BakeFrame& frame);

// What baking it would make, without making it.
Json describe_frame(const BakeFrame& frame);

// Bakes a frame: makes its files, all of them or none.
void bake_frame(const BakeFrame& frame);

}  // namespace solidnoise
