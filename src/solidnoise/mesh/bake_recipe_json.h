#pragma once

#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// The JSON form of a bake:
//   {"solidnoise": 1, "algorithm": 1,
//    "surface": {"noise": "surface", "error": 0.02, "impulses": 0, "layer": 0.5, "seed": 0, "octaves": 1,
//    "lacunarity": 2,
//                "gain": 0.5, "renormalize": true},
//    "frequency": [4, 32], "bandwidth": 1, "magnitude": 1, "bias": 0,
//    "by": {"source": "mean-curvature", "percentiles": [5, 95], "gamma": 1}, "smooth": 2, "smooth_radius": 0,
//    "direction": {"source": "axis", "axis": [0, 1, 0], "smooth": 10},
//    "ramp": "rust", "contrast": 1, "refine": {"mode": "off", "rounds": 1, "method": "own", "placement":
//    "edges"}, "displace": 0, "up": "y"}
// A parameter is one number, or two for what it is at both ends of what it follows. "by" has "attribute", the
// name of a number of the vertices, in place of "source" where it follows that. Every key but "solidnoise"
// may be left out; without "frequency" it is
// what suits the mesh, times "detail" (1). Reading back what was written gives an equal
// recipe, to the last bit.
Json to_json(const BakeRecipe& recipe);

// Throws std::invalid_argument with the path in the tree: another version, wrong type, unknown key, value out
// of range.
BakeRecipe bake_recipe_from_json(const Json& json);

// The JSON Schema of a bake.
Json bake_recipe_schema();

// What a bake would make: mesh, parameters, steering, recipe. Lengths in world units, frequencies in cycles
// per world unit.
Json describe_bake(const BakePlan& plan, const BakeRecipe& recipe);

}  // namespace solidnoise
