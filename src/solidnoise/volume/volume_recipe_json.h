#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/field/field_tables.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/volume_fields.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

inline constexpr Choices<Codec, 3> kCodecChoices{{
    {Codec::blosc, "blosc"},
    {Codec::zip, "zip"},
    {Codec::none, "none"},
}};

// The JSON form of a volume:
//   {"solidnoise": 1, "algorithm": 1, "noise": {"type": "gabor", ...}, "dims": 3, "time": 0, "offset": [0, 0,
//   0],
//    "shaping": {"type": "remap", ...}, "optical_depth": 60, "shape": {"type": "box"}, "box": [x0, ..., z1],
//    "dim": 256, "up": "y", "grid": "density", "half": false, "codec": "blosc"}
// "density" may take the place of "optical_depth", "voxel" that of "dim"; "density_factor" is there where it
// is known. "output", as format_outputs writes it, is there where it is not "value", with "speed", "boundary"
// ({"file": ..., "grid": ...}) and "boundary_width" where they are needed; "grid" only where there is one.
// "algorithm" is kAlgorithmVersion when the recipe was written. Every key but "solidnoise" may be left out. A
// recipe that works on a grid that exists has the keys of modification_json.h in place of "shape", "box",
// "dim" and "grid", which are the grid's. Reading back what was written gives an equal recipe, to the last
// bit, but for what has no effect.
Json to_json(const VolumeRecipe& recipe);

// Throws std::invalid_argument with the path in the tree: another version, wrong type, unknown key, two keys
// that contradict each other, value out of range.
VolumeRecipe volume_recipe_from_json(const Json& json);

// The JSON Schema of a volume.
Json volume_recipe_schema();

}  // namespace solidnoise
