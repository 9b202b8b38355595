#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/volume/field/distance_spline.h"
#include "solidnoise/volume/field/point_field.h"
#include "solidnoise/volume/modify/modify_volume.h"
#include "solidnoise/volume/parameters/parameter_fields.h"
#include "solidnoise/volume/parameters/varying_field.h"
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
  std::optional<TriangleMesh> mesh;  // of a MeshShape
  openvdb::GridBase::Ptr grid;       // of a GridShape
  std::optional<ModificationPlan> modification;

  std::optional<Boundary> boundary;  // the recipe's, with the digest of its file
  std::shared_ptr<const DistanceSpline> boundary_distance;

  std::shared_ptr<const ParameterFields> parameters;  // of a noise that has some, else null
};

// Validates the recipe and reads the files that its shape and parameters name. Throws std::invalid_argument
// (options) and std::runtime_error (files, also one that is not the file that the recipe's digest is of).
VolumePlan plan_volume(const VolumeRecipe& recipe, const VolumePart& part = {});

// Makes the volume, in parallel, from the plan of the same recipe, and finishes it (finish_volume()); a part
// of it is for merge_parts(). `creator`, such as "vdbnoise 0.1.0", goes into the metadata. Throws
// std::invalid_argument, Cancelled.
Volume make_volume(const VolumeRecipe& recipe, const VolumePlan& plan, const std::string& creator,
                   Progress* progress = nullptr);

// What make_volume() multiplies densities by, measured on the whole of the volume, whatever part the plan is
// of; nothing where all of it is 0. Of a sequence it is measured once, at the recipe's own time, and becomes
// DensityScale::factor, so that frames and parts of frames have one scale wherever they are made. The volume
// is made slab by slab, so that it takes no more memory than a part. Not for raw noise. Throws as
// make_volume().
std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const VolumePlan& plan,
                                             Progress* progress = nullptr);

// The noise of a recipe as it is in the volume: at the recipe's time, and a frame of it where it is of 4
// dimensions. Parameters are the recipe's own, not those of grids. Of a recipe with band_limit take it
// at_resolution(); throws std::invalid_argument.
std::shared_ptr<const Noise<3>> make_volume_noise(const VolumeRecipe& recipe);

// The lattice of a grid's voxels, with the period of the recipe's noise where that is a whole number of them.
LatticeFrame<3> voxel_lattice(const VolumeRecipe& recipe, const GridFrame& frame);

// The same, evaluated on these voxels by as few samples as the recipe's error allows (interpolate()), unless
// the recipe is exact.
std::shared_ptr<const Noise<3>> make_voxel_noise(const VolumeRecipe& recipe, const GridFrame& frame);

// The same of a recipe whose kernels vary, with the fields of its plan.
std::shared_ptr<const VaryingField> make_varying_volume_noise(const VolumeRecipe& recipe,
                                                              std::shared_ptr<const ParameterFields> fields);

// The field of a recipe whose shaping is RawShaping, at scattered points: its noise or its layers, in their
// range. Parameters, band limit and exceptions as above.
std::unique_ptr<PointField> make_volume_points(const VolumeRecipe& recipe);

// The same as make_voxel_noise() of make_quadrature(): a quarter of a wave behind the recipe's noise.
std::shared_ptr<const Noise<3>> make_voxel_quadrature(const VolumeRecipe& recipe, const GridFrame& frame);

// The highest frequency of the recipe's noise, or of those of its layers: the upper end of the band, cycles
// per world unit, where parameters are the greatest of the plan's. Folds and warps go beyond it.
double highest_frequency(const VolumeRecipe& recipe, const VolumePlan& plan);

}  // namespace solidnoise
