#pragma once

#include "solidnoise/noise/interpolation/noise_cost.h"
#include "solidnoise/volume/make_volume.h"

namespace solidnoise {

// Threads that work is done by (tbb::global_control).
int max_threads();

// How a volume is made.
enum class Making {
  in_memory,  // make_volume(), write_volume()
  streamed,   // stream_volume()
};

// What making a plan's voxels takes: seconds of all threads together, and bytes of all of them, with what the
// plan has read, the grids and the program itself. Known before any voxel is made, of all of the plan's
// voxels: shapes and clouds that leave many empty take less.
Cost volume_cost(const VolumeRecipe& recipe, const VolumePlan& plan, int threads,
                 Making making = Making::in_memory);

// What becomes of a volume: a file alone, or also a picture, or it goes to where there is no way back.
enum class Target { file, other };

// The way in which a volume is made, and what it costs: in memory, unless that takes more than `memory` bytes
// (0: any number) and it may be streamed to the target.
struct MakingPlan {
  Making making = Making::in_memory;
  Cost cost;
};
MakingPlan plan_making(const VolumeRecipe& recipe, const VolumePlan& plan, int threads, double memory,
                       Target target);

}  // namespace solidnoise
