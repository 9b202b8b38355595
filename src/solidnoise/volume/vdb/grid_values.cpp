#include "solidnoise/volume/vdb/grid_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {
namespace {

// Calls `visit(value, box of voxels)` for every active tile.
template <typename Grid, typename Visit>
void visit_active_tiles(const Grid& grid, const Visit& visit) {
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(Grid::TreeType::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    visit(tile.getValue(), box);
  }
}

// What measure() finds for each leaf of a grid, in tree order.
template <typename Grid>
auto measure_leaves(const Grid& grid) {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  openvdb::tree::LeafManager<const typename Grid::TreeType> leaves(grid.tree());
  std::vector<decltype(measure(std::declval<const Leaf&>()))> parts(leaves.leafCount());
  leaves.foreach ([&](const Leaf& leaf, std::size_t index) { parts[index] = measure(leaf); });
  return parts;
}

}  // namespace

Moments measure(const openvdb::FloatTree::LeafNodeType& leaf) {
  constexpr std::size_t kSize = openvdb::FloatTree::LeafNodeType::SIZE;
  const float* const values = leaf.buffer().data();
  if (leaf.isValueMaskOn()) return Moments::of({values, kSize});
  std::array<float, kSize> active;
  std::size_t count = 0;
  for (auto voxel = leaf.valueMask().beginOn(); voxel; ++voxel) active[count++] = values[voxel.pos()];
  return Moments::of({active.data(), count});
}

std::array<Moments, 3> measure(const openvdb::Vec3STree::LeafNodeType& leaf) {
  constexpr std::size_t kSize = openvdb::Vec3STree::LeafNodeType::SIZE;
  const openvdb::Vec3s* const values = leaf.buffer().data();
  std::array<std::array<float, kSize>, 3> active;
  std::size_t count = 0;
  for (auto voxel = leaf.valueMask().beginOn(); voxel; ++voxel, ++count) {
    for (int axis = 0; axis < 3; ++axis) active[axis][count] = values[voxel.pos()][axis];
  }
  std::array<Moments, 3> moments;
  for (int axis = 0; axis < 3; ++axis) moments[axis] = Moments::of({active[axis].data(), count});
  return moments;
}

Moments measure(const openvdb::FloatGrid& grid) {
  Moments total;
  for (const Moments& part : measure_leaves(grid)) total.merge(part);
  visit_active_tiles(grid, [&](float value, const openvdb::CoordBBox& box) {
    total.merge(Moments::of_constant(value, box.volume()));
  });
  return total;
}

std::array<Moments, 3> measure(const openvdb::Vec3SGrid& grid) {
  std::array<Moments, 3> total;
  for (const auto& part : measure_leaves(grid)) {
    for (int axis = 0; axis < 3; ++axis) total[axis].merge(part[axis]);
  }
  visit_active_tiles(grid, [&](const openvdb::Vec3s& value, const openvdb::CoordBBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
      total[axis].merge(Moments::of_constant(value[axis], box.volume()));
    }
  });
  return total;
}

void merge_moments(const openvdb::GridBase& grid, std::vector<Moments>& total) {
  if (grid.isType<openvdb::FloatGrid>()) {
    for (const Moments& part : measure_leaves(static_cast<const openvdb::FloatGrid&>(grid))) {
      total.front().merge(part);
    }
    return;
  }
  for (const auto& part : measure_leaves(dynamic_cast<const openvdb::Vec3SGrid&>(grid))) {
    for (std::size_t axis = 0; axis < part.size(); ++axis) total[axis].merge(part[axis]);
  }
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

ColumnSums::ColumnSums(const openvdb::CoordBBox& voxels, int axis) : voxels_(voxels), axis_(axis) {
  if (axis < 0 || axis > 2)
    throw std::invalid_argument(fmt::format("axis is {}; it must be 0, 1 or 2", axis));
  across_ = (axis + 1) % 3;
  along_ = (axis + 2) % 3;
  if (voxels.empty()) return;
  sums_.assign(
      static_cast<std::size_t>(voxels.dim()[across_]) * static_cast<std::size_t>(voxels.dim()[along_]), 0.0);
}

double& ColumnSums::column(const openvdb::Coord& voxel) {
  const auto row = static_cast<std::size_t>(voxel[across_] - voxels_.min()[across_]);
  const auto width = static_cast<std::size_t>(voxels_.dim()[along_]);
  return sums_[row * width + static_cast<std::size_t>(voxel[along_] - voxels_.min()[along_])];
}

// A tree's order goes up along each axis while the others stand still.
void ColumnSums::add(const openvdb::FloatGrid& grid) {
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) column(value.getCoord()) += *value;
  }
  visit_active_tiles(grid, [&](float value, openvdb::CoordBBox box) {
    const double depth = value * static_cast<double>(box.dim()[axis_]);
    box.max()[axis_] = box.min()[axis_];
    for (auto voxel = box.begin(); voxel; ++voxel) column(*voxel) += depth;
  });
}

double ColumnSums::largest() const {
  return sums_.empty() ? 0.0 : *std::max_element(sums_.begin(), sums_.end());
}

double thickest_column(const openvdb::FloatGrid& grid, int axis) {
  ColumnSums sums(grid.evalActiveVoxelBoundingBox(), axis);
  sums.add(grid);
  return sums.largest() * grid.transform().voxelSize()[axis];
}

namespace {

using FiniteGrids =
    openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid>;

struct Found {
  std::uint64_t count = 0;
  openvdb::Coord first;

  void add(const openvdb::Coord& voxel, std::uint64_t voxels) {
    if (voxels == 0) return;
    if (count == 0 || voxel < first) first = voxel;
    count += voxels;
  }
};

// Whether a number, or each of a vector, is within +-most.
template <typename Value>
bool is_within(const Value& value, double most) {
  if constexpr (std::is_floating_point_v<Value>) {
    return std::abs(static_cast<double>(value)) <= most;
  } else {
    return is_within(value[0], most) && is_within(value[1], most) && is_within(value[2], most);
  }
}

// Active or not.
template <typename Grid>
Found find_beyond(const Grid& grid, double most) {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  std::vector<const Leaf*> leaves;
  grid.tree().getNodes(leaves);
  const auto add_leaf = [&](const Leaf& leaf, Found& found) {
    for (openvdb::Index voxel = 0; voxel < Leaf::SIZE; ++voxel) {
      if (!is_within(leaf.getValue(voxel), most)) found.add(leaf.offsetToGlobalCoord(voxel), 1);
    }
  };
  Found found = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, leaves.size()), Found{},
      [&](const auto& range, Found part) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) add_leaf(*leaves[i], part);
        return part;
      },
      [](Found a, const Found& b) {
        a.add(b.first, b.count);
        return a;
      });
  auto tile = grid.tree().cbeginValueAll();
  tile.setMaxDepth(Grid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (!is_within(*tile, most)) found.add(tile.getCoord(), tile.getVoxelCount());
  }
  if (!is_within(grid.background(), most)) found.add(openvdb::Coord(), 1);
  return found;
}

}  // namespace

void require_finite_values(const openvdb::GridBase& grid, const std::string& name) {
  const bool half = grid.saveFloatAsHalf();
  const double most = half ? kLargestHalf : std::numeric_limits<double>::max();
  Found found;
  grid.apply<FiniteGrids>([&](const auto& typed) { found = find_beyond(typed, most); });
  if (found.count == 0) return;
  throw std::invalid_argument(fmt::format(
      "{} has {} values that are not finite{}, the first at voxel ({}, {}, {})", name, found.count,
      half ? " as 16-bit floats" : "", found.first.x(), found.first.y(), found.first.z()));
}

openvdb::Vec3SGrid::ConstPtr in_single_precision(const openvdb::GridBase& grid) {
  using openvdb::Vec3s;
  using openvdb::Vec3SGrid;
  if (grid.isType<Vec3SGrid>()) return static_cast<const Vec3SGrid&>(grid).copy();
  if (!grid.isType<openvdb::Vec3DGrid>()) return nullptr;
  const auto& doubles = static_cast<const openvdb::Vec3DGrid&>(grid);
  const auto floats = Vec3SGrid::create();
  floats->setName(doubles.getName());
  floats->setTransform(doubles.transform().copy());
  floats->setTree(std::make_shared<openvdb::Vec3STree>(doubles.tree(), Vec3s(doubles.background()),
                                                       openvdb::TopologyCopy()));
  const auto values = doubles.getConstAccessor();
  for (auto value = floats->beginValueOn(); value; ++value) {
    value.setValue(Vec3s(values.getValue(value.getCoord())));
  }
  return floats;
}

}  // namespace solidnoise
