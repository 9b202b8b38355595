#include "vdbnoise/dense_block.h"

#include <algorithm>

#include "solidnoise/volume/topology/grid_frame.h"

namespace solidnoise {
namespace {

constexpr int kShortestSide = 8;

bool all_active(const openvdb::FloatGrid& grid, const openvdb::CoordBBox& box) {
  const auto accessor = grid.getConstAccessor();
  for (auto voxel = box.begin(); voxel; ++voxel) {
    if (!accessor.isValueOn(*voxel)) return false;
  }
  return true;
}

// The middle of a box, its sides scaled and then cut to a length.
openvdb::CoordBBox middle_of(const openvdb::CoordBBox& box, double scale, int longest_side) {
  openvdb::CoordBBox middle;
  for (int axis = 0; axis < 3; ++axis) {
    const int length = box.dim()[axis];
    const int side = std::min(static_cast<int>(length * scale), longest_side);
    middle.min()[axis] = box.min()[axis] + (length - side) / 2;
    middle.max()[axis] = middle.min()[axis] + side - 1;
  }
  return middle;
}

}  // namespace

std::optional<DenseField<3>> dense_block(const openvdb::FloatGrid& grid, int longest_side) {
  const openvdb::CoordBBox bounds = grid.evalActiveVoxelBoundingBox();
  constexpr double kStep = 0.93;
  for (double scale = 1.0; !bounds.empty(); scale *= kStep) {
    const openvdb::CoordBBox box = middle_of(bounds, scale, longest_side);
    const openvdb::Coord sides = box.dim();
    if (std::min({sides.x(), sides.y(), sides.z()}) < kShortestSide) break;
    if (!all_active(grid, box)) continue;

    DenseField<3> block({sides.x(), sides.y(), sides.z()}, GridFrame(grid.transform()).voxel_size());
    const auto accessor = grid.getConstAccessor();
    float* value = block.values.data();
    for (auto voxel = box.begin(); voxel; ++voxel) *value++ = accessor.getValue(*voxel);
    return block;
  }
  return std::nullopt;
}

}  // namespace solidnoise
