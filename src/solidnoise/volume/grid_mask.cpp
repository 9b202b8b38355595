#include "solidnoise/volume/grid_mask.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/ValueTransformer.h>

#include "solidnoise/volume/require_finite_grid.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;

FloatGrid::Ptr coverage(const FloatGrid& grid) {
  FloatGrid::Ptr values = grid.deepCopy();
  const bool is_level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  const auto voxel = static_cast<float>(grid.voxelSize().x());
  openvdb::tools::foreach (values->beginValueAll(), [&](const FloatGrid::ValueAllIter& value) {
    const float factor = is_level_set ? 0.5f - *value / voxel : *value;
    value.setValue(std::clamp(factor, 0.0f, 1.0f));
  });
  const float background = is_level_set ? 0.5f - grid.background() / voxel : grid.background();
  values->tree().root().setBackground(std::clamp(background, 0.0f, 1.0f), /*updateChildNodes=*/false);
  return values;
}

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

FloatGrid::ConstPtr factors(const openvdb::GridBase& grid, const std::string& name) {
  require_finite_values(grid, name);
  if (grid.activeVoxelCount() == 0) throw std::invalid_argument(name + " has no active voxels");
  if (grid.isType<FloatGrid>()) return coverage(static_cast<const FloatGrid&>(grid));
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
    : values_(factors(grid, name)), accessor_(values_->getConstAccessor()) {}

float GridMask::at(const Vec<3>& world) const {
  const openvdb::Vec3d index = values_->worldToIndex({world.x, world.y, world.z});
  return openvdb::tools::BoxSampler::sample(accessor_, index);
}

std::uint64_t GridMask::memory() const {
  return values_->memUsage();
}

}  // namespace solidnoise
