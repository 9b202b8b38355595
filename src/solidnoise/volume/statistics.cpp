#include "solidnoise/volume/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <openvdb/tree/LeafManager.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

// Calls `visit(value, box of voxels)` for every active tile.
template <typename Visit>
void visit_active_tiles(const openvdb::FloatGrid& grid, const Visit& visit) {
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    visit(tile.getValue(), box);
  }
}

}  // namespace

Moments measure(const openvdb::FloatTree::LeafNodeType& leaf) {
  const float* const values = leaf.buffer().data();
  if (leaf.isValueMaskOn()) return Moments::of({values, Leaf::SIZE});
  std::array<float, Leaf::SIZE> active;
  std::size_t count = 0;
  for (auto voxel = leaf.valueMask().beginOn(); voxel; ++voxel) active[count++] = values[voxel.pos()];
  return Moments::of({active.data(), count});
}

Moments measure(const openvdb::FloatGrid& grid) {
  openvdb::tree::LeafManager<const openvdb::FloatTree> leaves(grid.tree());
  std::vector<Moments> parts(leaves.leafCount());
  leaves.foreach ([&](const Leaf& leaf, std::size_t index) { parts[index] = measure(leaf); });
  Moments total;
  for (const Moments& part : parts) total.merge(part);
  visit_active_tiles(grid, [&](float value, const openvdb::CoordBBox& box) {
    total.merge(Moments::of_constant(value, box.volume()));
  });
  return total;
}

Histogram histogram(const openvdb::FloatGrid& grid, double lower, double upper, int bins) {
  require_finite("the histogram's lower limit", lower);
  require_finite("the histogram's upper limit", upper);
  require_at_least("the histogram's number of bins", bins, 1.0);
  if (!(lower < upper)) {
    throw std::invalid_argument(fmt::format(
        "the histogram's upper limit is {}; it must be greater than the lower, {}", upper, lower));
  }
  Histogram result{lower, upper, std::vector<std::uint64_t>(static_cast<std::size_t>(bins)), 0, 0};
  const double per_unit = bins / (upper - lower);
  const auto add = [&](double value, std::uint64_t count) {
    if (value < lower) {
      result.below += count;
    } else if (!(value <= upper)) {
      result.above += count;
    } else {
      const auto bin = static_cast<std::size_t>((value - lower) * per_unit);
      result.counts[std::min(bin, result.counts.size() - 1)] += count;
    }
  };
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) add(*value, 1);
  }
  visit_active_tiles(grid, [&](float value, const openvdb::CoordBBox& box) { add(value, box.volume()); });
  return result;
}

double thickest_column(const openvdb::FloatGrid& grid, int axis) {
  if (axis < 0 || axis > 2)
    throw std::invalid_argument(fmt::format("axis is {}; it must be 0, 1 or 2", axis));
  const openvdb::CoordBBox bounds = grid.evalActiveVoxelBoundingBox();
  if (bounds.empty()) return 0.0;

  // One sum per column, over the two other axes.
  const int across = (axis + 1) % 3;
  const int along = (axis + 2) % 3;
  const auto width = static_cast<std::size_t>(bounds.dim()[along]);
  std::vector<double> sums(static_cast<std::size_t>(bounds.dim()[across]) * width, 0.0);
  const auto column = [&](const openvdb::Coord& voxel) -> double& {
    return sums[static_cast<std::size_t>(voxel[across] - bounds.min()[across]) * width +
                static_cast<std::size_t>(voxel[along] - bounds.min()[along])];
  };
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) column(value.getCoord()) += *value;
  }
  visit_active_tiles(grid, [&](float value, openvdb::CoordBBox box) {
    const double depth = value * static_cast<double>(box.dim()[axis]);
    box.max()[axis] = box.min()[axis];
    for (auto voxel = box.begin(); voxel; ++voxel) column(*voxel) += depth;
  });
  return *std::max_element(sums.begin(), sums.end()) * grid.transform().voxelSize()[axis];
}

}  // namespace solidnoise
