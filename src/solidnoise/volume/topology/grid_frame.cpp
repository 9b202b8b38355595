#include "solidnoise/volume/topology/grid_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// OpenVDB's indices are 32-bit; this leaves room for leaf and node borders.
constexpr double kLargestIndex = 1 << 30;

// Boxes are typed as decimal numbers: a border that is meant to lie on a voxel's centre may miss it by
// rounding.
constexpr double kTolerance = 1e-6;

// The first index whose centre is at or past `coordinate`.
std::int32_t first_index(double coordinate, double origin, double voxel_size) {
  const double index = std::ceil((coordinate - origin) / voxel_size - kTolerance);
  if (!(std::abs(index) <= kLargestIndex)) {
    throw std::invalid_argument(
        fmt::format("position {} is {:.3g} voxels of size {} from the origin; at most 2^30 are possible",
                    coordinate, std::abs(index), voxel_size));
  }
  return static_cast<std::int32_t>(index);
}

}  // namespace

GridFrame::GridFrame(double voxel_size) : voxel_size_(voxel_size) {
  require_positive("voxel", voxel_size, "world units");
  require_at_least("voxel", voxel_size, kLeastVoxel, "world units, the least that OpenVDB has");
}

GridFrame::GridFrame(const openvdb::math::Transform& transform) {
  const openvdb::Vec3d origin = transform.indexToWorld(openvdb::Vec3d(0.0));
  bool usable = transform.isLinear();
  for (int axis = 0; axis < 3; ++axis) {
    openvdb::Vec3d unit(0.0);
    unit[axis] = 1.0;
    const openvdb::Vec3d step = transform.indexToWorld(unit) - origin;
    // A rotation by a right angle leaves rounding errors; anything smaller than they are is no rotation.
    const double across = std::abs(step[(axis + 1) % 3]) + std::abs(step[(axis + 2) % 3]);
    usable = usable && std::isfinite(step[axis]) && step[axis] > 0.0 && across < 1e-9 * step[axis] &&
             std::isfinite(origin[axis]);
    origin_[axis] = origin[axis];
    voxel_size_[axis] = transform.voxelSize()[axis];
  }
  if (!usable) {
    throw std::invalid_argument(
        "the grid's transform is rotated, sheared, mirrored or not linear; only scale and translation are "
        "supported");
  }
}

openvdb::math::Transform::Ptr GridFrame::transform() const {
  const openvdb::Vec3d scale(voxel_size_.x, voxel_size_.y, voxel_size_.z);
  const openvdb::Vec3d translation(origin_.x, origin_.y, origin_.z);
  if (origin_ == Vec<3>(0.0) && voxel_size_ == Vec<3>(voxel_size_.x)) {
    return openvdb::math::Transform::createLinearTransform(voxel_size_.x);
  }
  openvdb::math::MapBase::Ptr map;
  if (voxel_size_ == Vec<3>(voxel_size_.x)) {
    map = std::make_shared<openvdb::math::UniformScaleTranslateMap>(voxel_size_.x, translation);
  } else {
    map = std::make_shared<openvdb::math::ScaleTranslateMap>(scale, translation);
  }
  return std::make_shared<openvdb::math::Transform>(map);
}

openvdb::CoordBBox GridFrame::voxels_in(const Box<3>& box) const {
  openvdb::Coord lower;
  openvdb::Coord upper;
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = first_index(box.lower[axis], origin_[axis], voxel_size_[axis]);
    upper[axis] = first_index(box.upper[axis], origin_[axis], voxel_size_[axis]) - 1;
    if (upper[axis] < lower[axis]) return {};
  }
  return {lower, upper};
}

Box<3> GridFrame::bounds(const openvdb::CoordBBox& voxels) const {
  return lattice(voxels).bounds();
}

Lattice<3> GridFrame::lattice(const openvdb::CoordBBox& voxels) const {
  Lattice<3> lattice;
  lattice.origin = origin_;
  lattice.step = voxel_size_;
  for (int axis = 0; axis < 3; ++axis) {
    lattice.first[axis] = voxels.min()[axis];
    lattice.count[axis] = voxels.max()[axis] - voxels.min()[axis] + 1;
  }
  return lattice;
}

double voxel_size_for_dim(const Box<3>& box, std::int64_t dim) {
  require_at_least("dim", static_cast<double>(dim), 1.0, "voxels along the longest side");
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, box.upper[axis] - box.lower[axis]);
  require_positive("the box's longest side", longest, "world units");
  return longest / static_cast<double>(dim);
}

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
