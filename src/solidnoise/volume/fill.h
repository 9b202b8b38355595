#pragma once

#include <string>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/field.h"
#include "solidnoise/volume/openvdb.h"
#include "solidnoise/volume/statistics.h"
#include "solidnoise/volume/topology.h"

namespace solidnoise {

// What becomes of voxels where the field is 0, the background.
enum class Sparsity {
  keep,  // the grid's active voxels are the topology's
  drop,  // voxels that are exactly 0 are inactive, and leaves of nothing else are not kept
};

struct FilledGrid {
  openvdb::FloatGrid::Ptr grid;  // background 0, in the topology's frame, class unknown, without a name
  Moments moments;               // of the active voxels
};

// Evaluates a field at every voxel of a topology, in parallel: one block for each group of 4 x 4 x 4 leaves,
// one evaluation for each leaf. Values, active voxels and moments are the same to the last bit for any number
// of threads (tbb::global_control sets it) and any topology that holds the voxel. Progress counts leaves.
// Throws Cancelled, and what the field throws.
FilledGrid fill_grid(const Topology& topology, const Field& field, Sparsity sparsity,
                     Progress* progress = nullptr);

// Multiplies every value; the background, 0, stays. Moments are then to be measured anew.
void scale_values(openvdb::FloatGrid& grid, float factor);

}  // namespace solidnoise
