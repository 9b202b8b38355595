#include "solidnoise/volume/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
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

Moments Moments::of(std::span<const float> values) {
  Moments result;
  if (values.empty()) return result;
  result.count_ = values.size();
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  result.min_ = *low;
  result.max_ = *high;
  double sum = 0.0;
  for (const float value : values) sum += value;
  result.mean_ = sum / static_cast<double>(values.size());
  for (const float value : values) {
    const double d = value - result.mean_;
    result.m2_ += d * d;
    result.m3_ += d * d * d;
    result.m4_ += d * d * d * d;
  }
  return result;
}

Moments Moments::of_constant(float value, std::uint64_t count) {
  Moments result;
  if (count == 0) return result;
  result.count_ = count;
  result.min_ = result.max_ = result.mean_ = value;
  return result;
}

void Moments::merge(const Moments& other) {
  if (other.count_ == 0) return;
  if (count_ == 0) {
    *this = other;
    return;
  }
  const double a = static_cast<double>(count_);
  const double b = static_cast<double>(other.count_);
  const double n = a + b;
  const double d = other.mean_ - mean_;
  const double d_n = d / n;
  m4_ += other.m4_ + d * d_n * d_n * d_n * a * b * (a * a - a * b + b * b) +
         6.0 * d_n * d_n * (a * a * other.m2_ + b * b * m2_) + 4.0 * d_n * (a * other.m3_ - b * m3_);
  m3_ += other.m3_ + d * d_n * d_n * a * b * (a - b) + 3.0 * d_n * (a * other.m2_ - b * m2_);
  m2_ += other.m2_ + d * d_n * a * b;
  mean_ += d_n * b;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
  count_ += other.count_;
}

double Moments::sigma() const {
  return count_ == 0 ? 0.0 : std::sqrt(m2_ / static_cast<double>(count_));
}

double Moments::skewness() const {
  return m2_ > 0.0 ? std::sqrt(static_cast<double>(count_)) * m3_ / std::pow(m2_, 1.5) : 0.0;
}

double Moments::excess_kurtosis() const {
  return m2_ > 0.0 ? static_cast<double>(count_) * m4_ / (m2_ * m2_) - 3.0 : 0.0;
}

Moments measure(const openvdb::FloatGrid& grid) {
  openvdb::tree::LeafManager<const openvdb::FloatTree> leaves(grid.tree());
  std::vector<Moments> parts(leaves.leafCount());
  leaves.foreach ([&](const Leaf& leaf, std::size_t index) {
    std::array<float, Leaf::SIZE> values;
    std::size_t count = 0;
    for (auto value = leaf.cbeginValueOn(); value; ++value) values[count++] = *value;
    parts[index] = Moments::of({values.data(), count});
  });
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
