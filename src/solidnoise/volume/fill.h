#pragma once

#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/grid_sink.h"
#include "solidnoise/volume/statistics.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

struct FilledGrid {
  openvdb::FloatGrid::Ptr grid;  // background 0, in the topology's frame, class unknown, without a name
  Moments moments;               // of the active voxels
};

// Evaluates a field at every voxel of a topology, in parallel: one block for each group of leaves, a cube
// of 64 voxels, or 32 in small topologies, and one evaluation for each ten of its leaves. Values, active
// voxels and moments are the same to the last bit for any number of threads (tbb::global_control sets it) and
// any topology that holds the voxel. Progress counts leaves. Throws Cancelled, what the field throws, and
// std::invalid_argument if the field has several channels.
FilledGrid fill_grid(const Topology& topology, const Field& field, Sparsity sparsity,
                     Progress* progress = nullptr);

// The same for a field of several channels: they become, in their order, grids of so many components each, 1
// for floats and 3 for vectors; each evaluation serves all grids. Voxels are dropped of each grid by its own
// values. Throws std::invalid_argument also if the components do not add up to the field's channels.
std::vector<MeasuredGrid> fill_grids(const Topology& topology, const Field& field,
                                     const std::vector<int>& components, Sparsity sparsity,
                                     Progress* progress = nullptr);

// Multiplies every value; the background, 0, stays. Moments are then to be measured anew.
void scale_values(openvdb::FloatGrid& grid, float factor);

}  // namespace solidnoise
