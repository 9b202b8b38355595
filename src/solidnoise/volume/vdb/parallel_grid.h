#pragma once

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The same grid for writing: OpenVDB compresses the values of one leaf after the other, which takes longer
// than making noise; this one compresses many leaves at once (tbb::global_control sets the threads) and
// writes them in order, to the same bytes. Shares the tree. Grids of other types than float and vec3s are
// returned as they are.
openvdb::GridBase::ConstPtr parallel_grid(const openvdb::GridBase::ConstPtr& grid);

}  // namespace solidnoise
