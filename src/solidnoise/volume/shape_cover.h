#pragma once

#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// The voxels of a recipe's shape, and how much of each is in it.
struct ShapedVoxels {
  Topology topology;
  FieldPtr cover;  // 0 to 1; null: 1 for every voxel of the topology
};

// Densities end softly at the surface of an ellipsoid or a mesh (cover_at()), over the recipe's edge or two
// voxels, over which no step is more than a half. So the mass is that of the shape, whatever the voxels.
// Boxes, of which tiles and parts are cut, do so where the recipe has an edge. Recipes without densities have
// the voxels whose centres are in the shape, and no cover. Throws as the topologies do; Cancelled.
ShapedVoxels make_shape(const VolumeRecipe& recipe, const VolumePlan& plan, Progress* progress);

}  // namespace solidnoise
