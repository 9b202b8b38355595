#pragma once

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid of vec3s or vec3d as one of vec3s, which shares the tree if it is one already. Null for a grid of
// another type.
openvdb::Vec3SGrid::ConstPtr in_single_precision(const openvdb::GridBase& grid);

}  // namespace solidnoise
