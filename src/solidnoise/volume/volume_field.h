#pragma once

#include <memory>
#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/field/normalization.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/noise/interpolation/point_plan.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What the voxels of a recipe are filled with, and the channels that its grids take of it, in their order. On
// the voxels of the plan noise is interpolated where that is quicker within the recipe's error; at points it
// is as it is.
struct VolumeField {
  FieldPtr field;
  std::vector<GridChannels> grids;
};
VolumeField make_volume_field(const VolumeRecipe& recipe, const VolumePlan& plan, FieldPtr cover = nullptr);

// Whether the voxels of a short form are known before their values: all of its shape. Else those that are 0
// are left out.
bool keeps_all_voxels(const VolumeRecipe& recipe);

// What RawShaping::normalize makes of the values of a short form's noise in a box, along whose axes with a
// period it is measured over one; of other recipes nothing.
Normalization normalization_of(const VolumeRecipe& recipe, const Box<3>& box);

// The noise of a recipe as it is in the volume: at the recipe's time, and a frame of it where it is of 4
// dimensions. Parameters are the recipe's own, not those of grids. Of a recipe with band_limit take it
// at_resolution(); throws std::invalid_argument.
std::shared_ptr<const Noise<3>> make_volume_noise(const VolumeRecipe& recipe);

// The same of a recipe whose kernels vary, with the parameters of its plan.
FieldPtr make_varying_volume_noise(const VolumeRecipe& recipe, const VolumePlan& plan);

// Where warps of so many world units in all move a volume's voxels.
PointSpread spread_by_warp(const VolumePlan& plan, double amount);

// The lattice of a grid's voxels, with the period of the recipe's noise where that is a whole number of them.
LatticeFrame<3> voxel_lattice(const VolumeRecipe& recipe, const GridFrame& frame);

// The highest frequency of the recipe's noise, or of those of its layers: the upper end of the band, cycles
// per world unit, where parameters are the greatest of the plan's. Folds and warps go beyond it.
double highest_frequency(const VolumeRecipe& recipe, const VolumePlan& plan);

}  // namespace solidnoise
