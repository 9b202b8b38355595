#pragma once

#include <string>

#include "solidnoise/core/vec.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid as a mask: a factor from 0 to 1 anywhere in the world, interpolated trilinearly between the grid's
// voxels, whatever its transform. Of
//   floats          the value, clamped to 0..1
//   a level set     1 inside, 0 outside, 1/2 - distance / voxel size between: how much of a voxel is inside
//   bools, or mask  1 where the value is true, or the voxel active
// One per thread: copies are cheap, and share the grid.
class GridMask {
 public:
  // Throws std::invalid_argument if the grid is of another type, has values that are not finite or no active
  // voxels. `name` says in messages which grid it is.
  GridMask(const openvdb::GridBase& grid, const std::string& name);

  float at(const Vec<3>& world) const;

 private:
  openvdb::FloatGrid::ConstPtr values_;
  openvdb::FloatGrid::ConstAccessor accessor_;
  bool is_level_set_;
  float voxel_;
};

// A grid of rest positions: for each point of what has moved, where it was at first, in world units. Noise
// that is looked up there moves with the thing instead of standing still while the thing goes through it.
// Interpolated trilinearly between those voxels that are active, whatever the grid's transform. One per
// thread: copies are cheap.
class RestPositions {
 public:
  // The grid must outlive this. Throws std::invalid_argument if it is not of vec3s or vec3d, or has values
  // that are not finite. `name` says in messages which grid it is.
  RestPositions(const openvdb::GridBase& grid, const std::string& name);

  // Throws std::runtime_error, naming the place, if no voxel around it is active.
  Vec<3> at(const Vec<3>& world) const;

 private:
  std::string name_;
  openvdb::Vec3SGrid::ConstPtr values_;
  openvdb::Vec3SGrid::ConstAccessor accessor_;
};

}  // namespace solidnoise
