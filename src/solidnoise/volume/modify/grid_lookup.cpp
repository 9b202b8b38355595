#include "solidnoise/volume/modify/grid_lookup.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <openvdb/tools/Interpolation.h>

#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;

// 1 at the voxels that are on.
template <typename Grid, typename IsOn>
FloatGrid::Ptr indicator(const Grid& grid, const IsOn& is_on) {
  FloatGrid::Ptr values = FloatGrid::create(0.0f);
  values->setTransform(grid.transform().copy());
  const openvdb::FloatTree ones(grid.tree(), 0.0f, 1.0f, openvdb::TopologyCopy());
  values->setTree(std::make_shared<openvdb::FloatTree>(ones));
  for (auto value = values->beginValueOn(); value; ++value) {
    if (!is_on(value.getCoord())) value.setValue(0.0f);
  }
  return values;
}

FloatGrid::ConstPtr values_of(const openvdb::GridBase& grid, const std::string& name) {
  require_finite_values(grid, name);
  if (grid.activeVoxelCount() == 0) throw std::invalid_argument(name + " has no active voxels");
  if (grid.isType<FloatGrid>()) return static_cast<const FloatGrid&>(grid).copy();
  if (grid.isType<openvdb::BoolGrid>()) {
    const auto& bools = static_cast<const openvdb::BoolGrid&>(grid);
    return indicator(bools, [values = bools.getConstAccessor()](const openvdb::Coord& voxel) {
      return values.getValue(voxel);
    });
  }
  if (grid.isType<openvdb::MaskGrid>()) {
    return indicator(static_cast<const openvdb::MaskGrid&>(grid), [](const openvdb::Coord&) { return true; });
  }
  throw std::invalid_argument(
      fmt::format("{} is of type {}; a mask must be of float, bool or mask", name, grid.valueType()));
}

}  // namespace

GridMask::GridMask(const openvdb::GridBase& grid, const std::string& name)
    : values_(values_of(grid, name)),
      accessor_(values_->getConstAccessor()),
      is_level_set_(values_->getGridClass() == openvdb::GRID_LEVEL_SET),
      voxel_(static_cast<float>(values_->voxelSize().x())) {}

float GridMask::at(const Vec<3>& world) const {
  const openvdb::Vec3d index = values_->worldToIndex({world.x, world.y, world.z});
  const float value = openvdb::tools::BoxSampler::sample(accessor_, index);
  return std::clamp(is_level_set_ ? 0.5f - value / voxel_ : value, 0.0f, 1.0f);
}

namespace {

using openvdb::Vec3SGrid;

// The precision in which noise takes positions within a leaf.
Vec3SGrid::ConstPtr read_vectors(const openvdb::GridBase& grid, const std::string& name) {
  require_finite_values(grid, name);
  if (Vec3SGrid::ConstPtr vectors = in_single_precision(grid)) return vectors;
  throw std::invalid_argument(
      fmt::format("{} is of type {}; rest positions must be of vec3s or vec3d", name, grid.valueType()));
}

}  // namespace

RestPositions::RestPositions(const openvdb::GridBase& grid, const std::string& name)
    : name_(name), values_(read_vectors(grid, name)), accessor_(values_->getConstAccessor()) {}

Vec<3> RestPositions::at(const Vec<3>& world) const {
  constexpr double kLeastWeight = 1e-6;  // what rounding may leave of a voxel next to the one that is meant
  const openvdb::Vec3d index = values_->worldToIndex({world.x, world.y, world.z});
  openvdb::Coord corner;
  double fraction[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = std::floor(index[axis]);
    corner[axis] = static_cast<int>(lower);
    fraction[axis] = index[axis] - lower;
  }
  Vec<3> sum(0.0);
  double total = 0.0;
  for (int i = 0; i < 8; ++i) {
    double weight = 1.0;
    openvdb::Coord voxel = corner;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = (i >> axis & 1) != 0;
      voxel[axis] += upper;
      weight *= upper ? fraction[axis] : 1.0 - fraction[axis];
    }
    openvdb::Vec3s value;
    if (weight < kLeastWeight || !accessor_.probeValue(voxel, value)) continue;
    sum += weight * Vec<3>(value.x(), value.y(), value.z());
    total += weight;
  }
  if (total == 0.0) {
    throw std::runtime_error(
        fmt::format("{} has no rest position at ({:.6g}, {:.6g}, {:.6g}), where the other grid has a value",
                    name_, world.x, world.y, world.z));
  }
  return sum / total;
}

}  // namespace solidnoise
