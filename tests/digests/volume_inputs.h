#pragma once

#include <filesystem>

#include "solidnoise/recipe/json.h"

namespace solidnoise {

// Writes into a folder what recipes of volumes read, made of formulas, in the cube from -1.2 to 1.2 or a
// larger one:
//   smoke.vdb    `density`, a ball of up to 20        turned.vdb  the same on a turned lattice
//   surface.vdb  `surface`, the level set of a ball   vel.vdb     `vel`, directions around z
//   paint.vdb    `paint`, 0 to 1 along x; `ramp`, 1 to 7 along x; `narrow`, 0.7 to 1.7 along y
//   rest.vdb     `rest`, positions twice as large     torus.obj   a sample mesh
void write_volume_inputs(const std::filesystem::path& folder);

// The recipe with its files in that folder; where a grid is to be worked on and none is named, that is
// smoke.vdb, or surface.vdb to displace.
Json with_inputs(Json recipe, const std::filesystem::path& folder);

}  // namespace solidnoise
