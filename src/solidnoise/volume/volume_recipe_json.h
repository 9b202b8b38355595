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
//   {"solidnoise": 2, "algorithm": 4, "noise": {"type": "gabor", ...}, "dims": 3, "time": 0,
//    "offset": [0, 0, 0],
//    "fields": {"billows": {"fold": "billow", ...}, ...},
//    "grids": [{"name": "density", "layers": [{"use": "billows"}], "shaping": {"type": "remap", ...},
//               "scale": {"optical_depth": 60}, "half": false}, ...],
//    "domain": {"shape": {"type": "box"}, "box": [x0, ..., z1], "dim": 256}, "up": "y", "codec": "blosc"}
// A grid has "noise" where it has one of its own, "output" where that is not "value", and "speed", "drift",
// "boundary" ({"file": ..., "grid": ...}) and "boundary_width" where they are needed; "peak" may take the
// place of "optical_depth", "voxel" that of "dim"; "factor" is there where it is known. "algorithm" is
// kAlgorithmVersion when the recipe was written. Every key but "solidnoise" may be left out. A recipe that
// works on a grid that exists has the keys of modification_json.h in place of "domain" and "name", which are
// the grid's. Reading back what was written gives an equal recipe, to the last bit, but for what has no
// effect.
//
// The short form, which version 1 was, has the keys of a single grid and of the domain as its own, with
// "grid" for the name and "optical_depth", "density" or "density_factor" for the scale. It is read, not
// written.
Json to_json(const VolumeRecipe& recipe);

// Throws std::invalid_argument with the path in the tree: another version, wrong type, unknown key, two keys
// that contradict each other, value out of range.
VolumeRecipe volume_recipe_from_json(const Json& json);

// The JSON Schema of a volume.
Json volume_recipe_schema();

}  // namespace solidnoise
