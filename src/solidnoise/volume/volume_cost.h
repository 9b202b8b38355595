#pragma once

#include <filesystem>
#include <vector>

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

// Seconds that one thread takes for a short form's field at so many points.
double seconds_at_points(const VolumeRecipe& recipe, const PointWork& work);

// What merging so many parts of the whole takes, by one thread.
Cost merge_cost(const VolumeRecipe& recipe, const VolumePlan& whole, int parts);

// What becomes of a volume.
enum class Target {
  file,
  picture,  // with or without a file
  pipe,     // a file without a way back
};

// The way in which a volume is made, and what it costs: in memory, unless that takes more than `memory` bytes
// (0: any number) and it may be streamed to the target. The cost has a picture's memory with it.
struct MakingPlan {
  Making making = Making::in_memory;
  Cost cost;
};
MakingPlan plan_making(const VolumeRecipe& recipe, const VolumePlan& plan, int threads, double memory,
                       Target target);

// What merging parts takes that exist, by what their files say of themselves. Throws what read_vdb_summary()
// throws.
Cost merge_cost(const std::vector<std::filesystem::path>& parts, Making making, Target target);

}  // namespace solidnoise
