#pragma once

#include "solidnoise/noise/interpolation/noise_cost.h"
#include "solidnoise/volume/make_volume.h"

namespace solidnoise {

// Threads that work is done by (tbb::global_control).
int max_threads();

// What making a plan's voxels takes: seconds of all threads together, and bytes of all of them, with what the
// plan has read, the grids and the program itself. Known before any voxel is made, of all of the plan's
// voxels: shapes and clouds that leave many empty take less.
Cost volume_cost(const VolumeRecipe& recipe, const VolumePlan& plan, int threads);

}  // namespace solidnoise
