#pragma once

#include "solidnoise/core/choices.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

inline constexpr Choices<SurfaceNoiseKind, 6> kSurfaceNoiseChoices{{
    {SurfaceNoiseKind::surface, "surface"},
    {SurfaceNoiseKind::oriented, "oriented"},
    {SurfaceNoiseKind::solid, "solid"},
    {SurfaceNoiseKind::kensler, "kensler"},
    {SurfaceNoiseKind::kensler_solid, "kensler-solid"},
    {SurfaceNoiseKind::spectrum, "spectrum"},
}};

// An attribute is given by its name instead.
inline constexpr Choices<SteeringSource, 5> kSteeringChoices{{
    {SteeringSource::mean_curvature, "mean-curvature"},
    {SteeringSource::gaussian_curvature, "gaussian-curvature"},
    {SteeringSource::max_curvature, "max-curvature"},
    {SteeringSource::abs_curvature, "abs-curvature"},
    {SteeringSource::height, "height"},
}};

inline constexpr Choices<DirectionRecipe::Source, 3> kDirectionChoices{{
    {DirectionRecipe::Source::axis, "axis"},
    {DirectionRecipe::Source::max_curvature, "max-curvature"},
    {DirectionRecipe::Source::min_curvature, "min-curvature"},
}};

inline constexpr Choices<RefineRecipe::Mode, 3> kRefineChoices{{
    {RefineRecipe::Mode::off, "off"},
    {RefineRecipe::Mode::automatic, "auto"},
    {RefineRecipe::Mode::rounds, "rounds"},
}};
inline constexpr Choices<RefineOptions::Method, 4> kRefineMethodChoices{{
    {RefineOptions::Method::own, "own"},
    {RefineOptions::Method::longest_edge, "longest-edge"},
    {RefineOptions::Method::sqrt3, "sqrt3"},
    {RefineOptions::Method::loop, "loop"},
}};
inline constexpr Choices<RefineOptions::Placement, 2> kPlacementChoices{{
    {RefineOptions::Placement::on_edges, "edges"},
    {RefineOptions::Placement::smooth, "smooth"},
}};

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

}  // namespace solidnoise
