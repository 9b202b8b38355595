#include "solidnoise/volume/modify/grid_mask.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <openvdb/tools/Interpolation.h>

#include "solidnoise/volume/vdb/require_finite_grid.h"

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

}  // namespace solidnoise
