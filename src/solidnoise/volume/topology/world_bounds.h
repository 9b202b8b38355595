#pragma once

#include "solidnoise/core/box.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A box in the world that holds a grid's active voxels and one voxel around them, whatever its transform.
Box<3> world_bounds(const openvdb::GridBase& grid);

}  // namespace solidnoise
