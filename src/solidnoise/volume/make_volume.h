#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/volume/modify/distance_spline.h"
#include "solidnoise/volume/modify/modify_volume.h"
#include "solidnoise/volume/parameters/parameter_fields.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/volume.h"
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
  std::uint64_t mask_memory = 0;     // of these, what the voxels take without values, and fields
  std::optional<TriangleMesh> mesh;  // of a MeshShape
  openvdb::GridBase::Ptr grid;       // of a GridShape
  std::optional<ModificationPlan> modification;

  // Of each entry of the recipe's grids: the surface that a velocity is to stay off, if there is one.
  struct GridBoundary {
    std::optional<GridFile> boundary;  // the entry's, with the digest of its file
    std::shared_ptr<const PlannedDistance> distance;
  };
  std::vector<GridBoundary> boundaries;

  std::shared_ptr<const ParameterFields> parameters;  // of a noise that has some, else null
};

// Validates the recipe and reads the files that its shape and parameters name. Throws std::invalid_argument
// (options), std::runtime_error (files, also one that is not the file that the recipe's digest is of),
// Cancelled.
VolumePlan plan_volume(const VolumeRecipe& recipe, const VolumePart& part = {}, Progress* progress = nullptr);

// The recipe with the digests of the files that the plan has read.
VolumeRecipe with_digests(const VolumeRecipe& recipe, const VolumePlan& plan);

// Makes the volume, in parallel, from the plan of the same recipe, and finishes it (finish_volume()); a part
// of it is for merge_parts(). `creator`, such as "vdbnoise 0.1.0", goes into the metadata. Throws
// std::invalid_argument, Cancelled.
Volume make_volume(const VolumeRecipe& recipe, const VolumePlan& plan, const std::string& creator,
                   Progress* progress = nullptr);

// Whether a file, which exists, is what make_volume() makes of the recipe and the plan, by the recipe, part
// and version in it; where all is read, also whether it is whole, and a part that which was written.
enum class Reading { headers, all };
bool holds_volume(const std::filesystem::path& path, const VolumeRecipe& recipe, const VolumePlan& plan,
                  Reading reading = Reading::all);

// Whether a short form's densities are scaled by something that is to be measured.
bool measures_density(const VolumeRecipe& recipe);

// What make_volume() multiplies the densities of a short form by, measured on the whole of the volume,
// whatever part the plan is of; nothing where all of it is 0. Of a sequence it is measured once, at the
// recipe's own time, and becomes DensityScale::factor, so that frames and parts of frames have one scale
// wherever they are made. The volume is made slab by slab, so that it takes no more memory than a part. Not
// for raw noise. Throws as make_volume().
std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const VolumePlan& plan,
                                             Progress* progress = nullptr);

}  // namespace solidnoise
