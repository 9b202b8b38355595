#include "solidnoise/volume/vdb/require_finite_grid.h"

#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {
namespace {

using FiniteGrids =
    openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid>;

struct Found {
  std::uint64_t count = 0;
  openvdb::Coord first;

  void add(const openvdb::Coord& voxel, std::uint64_t voxels) {
    if (count == 0 || voxel < first) first = voxel;
    count += voxels;
  }
};

template <typename Grid>
Found find_not_finite(const Grid& grid) {
  Found found;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      if (!openvdb::math::isFinite(*value)) found.add(value.getCoord(), 1);
    }
  }
  auto tile = grid.cbeginValueOn();
  tile.setMaxDepth(Grid::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (!openvdb::math::isFinite(*tile)) found.add(tile.getCoord(), tile.getVoxelCount());
  }
  return found;
}

}  // namespace

void require_finite_values(const openvdb::GridBase& grid, const std::string& name) {
  Found found;
  grid.apply<FiniteGrids>([&](const auto& typed) { found = find_not_finite(typed); });
  if (found.count == 0) return;
  throw std::invalid_argument(
      fmt::format("{} has {} values that are not finite, the first at voxel ({}, {}, {})", name, found.count,
                  found.first.x(), found.first.y(), found.first.z()));
}

}  // namespace solidnoise
