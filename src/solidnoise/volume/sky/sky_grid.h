#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/cost.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/sky/sky_plan.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/volume.h"

namespace solidnoise {

// All of a sky as one grid, in voxels of the recipe's size with voxel (0, 0, 0) at the world's origin: each
// cloud is made once, and added, scaled and turned, at its points, interpolated linearly between its voxels.
// Where clouds overlap their densities add up. With a region there are only the voxels whose centres c have
// lower <= c < upper, so that regions that share no more than faces share no voxel, and together have the
// voxels of their union: a sky in tiles, each of which makes the clouds that reach into it. Throws as
// make_volume(). The plan is of SkyForm::grid.
Volume make_sky_grid(const SkyPlan& plan, const std::optional<Box<3>>& region, const std::string& creator,
                     Progress* progress = nullptr);

// A box in the world around what stands at a point.
Box<3> bounds_of(const SkyPlan& plan, const SkyInstance& instance);

// The plan without what does not reach into a region.
SkyPlan plan_in(const SkyPlan& plan, const Box<3>& region);

// Of the leaves in the box of a cloud, the share that are not surely nothing.
double kept_share(const VolumeRecipe& recipe, const VolumePlan& plan);

// What placing the clouds takes beside making them; `kept` has the kept_share() of each.
Cost placing_cost(const SkyPlan& plan, const std::vector<double>& kept);

}  // namespace solidnoise
