#pragma once

#include <optional>

#include "solidnoise/core/field.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The share of a place that is in a body whose densities end softly, at the distance d from its surface,
// positive outside: 1/2 - d / edge, clamped to 0..1. `edge` in world units, > 0.
float cover_at(double distance, double edge);

struct Ellipsoid {
  Vec<3> centre;
  Vec<3> radii;
};

// The body of a shape in its box, where that is a sphere or an ellipsoid.
std::optional<Ellipsoid> ellipsoid_of(const Shape& shape, const Box<3>& box);

// The shares of places in such a body, or in the box: d is exact for a sphere; of an ellipsoid it is
// (k - 1) k / |g| with k the distance from the centre in radii and g = k grad k, right to first order.
FieldPtr cover_of(const Shape& shape, const Box<3>& box, double edge);

// Whether a grid of the recipe is a density: raw values are in the shape or not.
bool has_density(const VolumeRecipe& recipe);

// Over what width a recipe's densities end on voxels of a size, world units; 0: voxels are in the shape or
// not.
double edge_of(const VolumeRecipe& recipe, const Vec<3>& voxel);

// The shares of places in the shape of a recipe, where samples are so many world units apart: of densities as
// voxels of that size have them, else 0 or 1.
FieldPtr shape_at_points(const VolumeRecipe& recipe, double sample);

}  // namespace solidnoise
