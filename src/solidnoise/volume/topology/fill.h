#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What becomes of voxels where the field is 0, the background.
enum class Sparsity {
  keep,  // the grid's active voxels are the topology's
  drop,  // voxels that are exactly 0 are inactive, and leaves of nothing else are not kept
};

// A grid of floats or of vectors (Vec3SGrid).
struct MeasuredGrid {
  openvdb::GridBase::Ptr grid;
  std::vector<Moments> moments;  // of the active voxels, of each component
};

struct FilledGrid {
  openvdb::FloatGrid::Ptr grid;  // background 0, in the topology's frame, class unknown, without a name
  Moments moments;               // of the active voxels
};

// Evaluates a field at every voxel of a topology, in parallel: one block for each group of leaves, a cube
// of 64 voxels, or 32 in small topologies, and one evaluation for each ten of its leaves. Values, active
// voxels and moments are the same to the last bit for any number of threads (tbb::global_control sets it) and
// any topology that holds the voxel. Progress counts leaves. Throws Cancelled, what the field throws, and
// std::invalid_argument if the field has several channels.
FilledGrid fill_grid(const Topology& topology, const Field<3>& field, Sparsity sparsity,
                     Progress* progress = nullptr);

// What a grid takes of a field of several channels: as many as it has components, 1 for floats and 3 for
// vectors.
struct GridChannels {
  int first = 0;
  int count = 1;
  Sparsity sparsity = Sparsity::keep;  // by the grid's own values
};

// Several grids of one field; each evaluation serves all of them. Throws std::invalid_argument also if the
// field does not have the channels.
std::vector<MeasuredGrid> fill_grids(const Topology& topology, const Field<3>& field,
                                     const std::vector<GridChannels>& grids, Progress* progress = nullptr);

// Multiplies every value; the background, 0, stays. Moments are then to be measured anew.
void scale_values(openvdb::FloatGrid& grid, float factor);

}  // namespace solidnoise
