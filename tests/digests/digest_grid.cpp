#include "digests/digest_grid.h"

#include <cstdint>
#include <span>
#include <stdexcept>

namespace solidnoise {
namespace {

void add_value(float value, Digest& digest) {
  digest.add_one(value);
}
template <typename Number>
void add_value(const openvdb::math::Vec3<Number>& value, Digest& digest) {
  digest.add(std::span<const Number>(value.asPointer(), 3));
}

template <typename Grid>
void add_tree(const Grid& grid, Digest& digest) {
  const auto& tree = grid.tree();
  add_value(tree.background(), digest);
  constexpr int kDeepestTile = Grid::TreeType::DEPTH - 2;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(kDeepestTile);
  for (; tile; ++tile) {
    if (!tile.isValueOn() && *tile == tree.background()) continue;
    digest.add_one(tile.getCoord());
    digest.add_one(static_cast<std::uint64_t>(tile.getDepth()));
    digest.add_one(static_cast<std::uint64_t>(tile.isValueOn()));
    add_value(*tile, digest);
  }
  const bool everywhere = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    digest.add_one(leaf->origin());
    const auto& mask = leaf->getValueMask();
    for (openvdb::Index word = 0; word < mask.WORD_COUNT; ++word) {
      digest.add_one(mask.template getWord<std::uint64_t>(word));
    }
    for (openvdb::Index voxel = 0; voxel < leaf->SIZE; ++voxel) {
      if (everywhere || mask.isOn(voxel)) add_value(leaf->getValue(voxel), digest);
    }
  }
}

}  // namespace

void add_grid(const openvdb::GridBase& grid, Digest& digest) {
  digest.add(grid.getName());
  digest.add(openvdb::GridBase::gridClassToString(grid.getGridClass()));
  digest.add(openvdb::GridBase::vecTypeToString(grid.getVectorType()));
  digest.add_one(static_cast<std::uint64_t>(grid.saveFloatAsHalf()));
  const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
  digest.add(std::span<const double>(matrix.asPointer(), 16));
  if (grid.isType<openvdb::FloatGrid>()) {
    add_tree(dynamic_cast<const openvdb::FloatGrid&>(grid), digest);
  } else if (grid.isType<openvdb::Vec3SGrid>()) {
    add_tree(dynamic_cast<const openvdb::Vec3SGrid&>(grid), digest);
  } else {
    throw std::invalid_argument("no digest of a grid of " + grid.valueType());
  }
}

}  // namespace solidnoise
