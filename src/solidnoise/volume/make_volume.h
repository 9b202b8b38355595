#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/fill.h"
#include "solidnoise/volume/grid_frame.h"
#include "solidnoise/volume/openvdb.h"
#include "solidnoise/volume/triangle_mesh.h"
#include "solidnoise/volume/vdb_write.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Where a recipe's voxels will lie, before any of them is made. Holds what the recipe's shape was read from.
struct VolumePlan {
  Shape shape;  // the recipe's, with the digest of its file
  GridFrame frame{1.0};
  Box<3> box;                        // that of the recipe, the mesh or the grid
  openvdb::CoordBBox voxels;         // every voxel of the volume is among these
  std::uint64_t memory = 0;          // bytes that making it takes at most
  std::optional<TriangleMesh> mesh;  // of a MeshShape
  openvdb::GridBase::Ptr grid;       // of a GridShape
};

// Validates the recipe and reads the file that its shape names. Throws std::invalid_argument (options) and
// std::runtime_error (files, also one that is not the file that the recipe's digest is of).
VolumePlan plan_volume(const VolumeRecipe& recipe);

// Grids of the same active voxels, named, with their classes and metadata.
struct Volume {
  std::vector<MeasuredGrid> grids;  // at least one
};

// Makes the volume, in parallel, from the plan of the same recipe. `creator` such as "vdbnoise 0.1.0" goes
// into each grid's metadata, and so do the whole recipe (kRecipeKey, with the digest of its file), seed, up
// axis, algorithm version and statistics. Throws std::invalid_argument, Cancelled.
Volume make_volume(const VolumeRecipe& recipe, const VolumePlan& plan, const std::string& creator,
                   Progress* progress = nullptr);

// The noise of a recipe as it is in the volume: a frame of it, where the recipe's noise is of 4 dimensions.
std::shared_ptr<const Noise<3>> make_volume_noise(const VolumeRecipe& recipe);

// Name of the metadata of a grid that holds its recipe, as JSON.
inline constexpr char kRecipeKey[] = "solidnoise:recipe";

}  // namespace solidnoise
