#include "solidnoise/volume/topology/world_bounds.h"

#include <algorithm>
#include <limits>

namespace solidnoise {

Box<3> world_bounds(const openvdb::GridBase& grid) {
  const openvdb::CoordBBox voxels = grid.evalActiveVoxelBoundingBox();
  Box<3> box{Vec<3>(std::numeric_limits<double>::infinity()),
             Vec<3>(-std::numeric_limits<double>::infinity())};
  for (int corner = 0; corner < 8; ++corner) {
    openvdb::Vec3d index;
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = (corner >> axis & 1) != 0 ? voxels.max()[axis] + 1.0 : voxels.min()[axis] - 1.0;
    }
    const openvdb::Vec3d world = grid.indexToWorld(index);
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], world[axis]);
      box.upper[axis] = std::max(box.upper[axis], world[axis]);
    }
  }
  return box;
}

}  // namespace solidnoise
