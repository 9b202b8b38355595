#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/volume/modify/distance_spline.h"
#include "solidnoise/volume/modify/modify_volume.h"
#include "solidnoise/volume/parameters/parameter_fields.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Where a recipe's voxels will lie, before any of them is made. Holds what the recipe's shape was read from.
struct VolumePlan {
  Shape shape;      // the recipe's, with the digest of its file
  VolumePart part;  // what of it is to be made
  GridFrame frame{1.0};
  Box<3> box;                        // that of the recipe, the mesh or the grid
  openvdb::CoordBBox voxels;         // every voxel of the volume is among these
  std::uint64_t memory = 0;          // bytes that making it takes at most
  std::optional<TriangleMesh> mesh;  // of a MeshShape
  openvdb::GridBase::Ptr grid;       // of a GridShape
  std::optional<ModificationPlan> modification;

  // Of each entry of the recipe's grids: the surface that a velocity is to stay off, if there is one.
  struct GridBoundary {
    std::optional<Boundary> boundary;  // the entry's, with the digest of its file
    std::shared_ptr<const DistanceSpline> distance;
  };
  std::vector<GridBoundary> boundaries;

  std::shared_ptr<const ParameterFields> parameters;  // of a noise that has some, else null
};

// Validates the recipe and reads the files that its shape and parameters name. Throws std::invalid_argument
// (options) and std::runtime_error (files, also one that is not the file that the recipe's digest is of).
VolumePlan plan_volume(const VolumeRecipe& recipe, const VolumePart& part = {});

// The recipe with the digests of the files that the plan has read.
VolumeRecipe with_digests(const VolumeRecipe& recipe, const VolumePlan& plan);

}  // namespace solidnoise
