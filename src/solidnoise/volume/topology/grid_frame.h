#pragma once

#include <cstdint>

#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Where voxels lie in the world: voxel (i, j, k) has its centre at origin + size * (i, j, k), OpenVDB's
// convention. Axis-aligned; positions depend on the index alone, never on the region that is filled.
class GridFrame {
 public:
  static constexpr double kLeastVoxel = 1.5e-5;  // world units: the cube root of what OpenVDB takes for 0

  // Cubic voxels with voxel (0, 0, 0) at the world's origin. `voxel_size` in world units, > 0.
  // Throws std::invalid_argument.
  explicit GridFrame(double voxel_size);

  // The frame of a grid that exists. Throws std::invalid_argument if the transform rotates, shears, mirrors
  // or is not linear.
  explicit GridFrame(const openvdb::math::Transform& transform);

  const Vec<3>& origin() const { return origin_; }
  const Vec<3>& voxel_size() const { return voxel_size_; }  // world units

  openvdb::math::Transform::Ptr transform() const;

  // The voxels whose centres c lie in lower <= c < upper on each axis, with a tolerance of 1e-6 of a voxel:
  // boxes that share a face share no voxel, and together have the voxels of their union. An empty CoordBBox
  // if there are none. Throws std::invalid_argument if an index would leave +-2^30.
  openvdb::CoordBBox voxels_in(const Box<3>& box) const;

  // The box of the centres of these voxels.
  Box<3> bounds(const openvdb::CoordBBox& voxels) const;

  // The sample positions of these voxels, in the order of a leaf's buffer.
  Lattice<3> lattice(const openvdb::CoordBBox& voxels) const;

 private:
  Vec<3> origin_{0.0};
  Vec<3> voxel_size_{1.0};
};

// The voxel size that puts `dim` voxels along the box's longest side. Throws std::invalid_argument if dim is
// under 1 or the box has no extent.
double voxel_size_for_dim(const Box<3>& box, std::int64_t dim);

// A box in the world that holds a grid's active voxels and one voxel around them, whatever its transform.
Box<3> world_bounds(const openvdb::GridBase& grid);

}  // namespace solidnoise
