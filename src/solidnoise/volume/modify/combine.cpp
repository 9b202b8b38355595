#include "solidnoise/volume/modify/combine.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <openvdb/tree/LeafManager.h>

#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;
using openvdb::FloatTree;
using FloatLeaf = FloatTree::LeafNodeType;
using Leaves = openvdb::tree::LeafManager<FloatTree>;

// One value; all that is the same for all of them is made once.
class Combiner {
 public:
  Combiner(const FloatGrid& grid, const Combination& combination)
      : combine_(combination.combine),
        amount_(static_cast<float>(combination.amount)),
        is_fog_(grid.getGridClass() == openvdb::GRID_FOG_VOLUME) {
    if (combine_ != Combine::erode) return;
    peak_ = static_cast<float>(measure(grid).max());
    if (!(peak_ > 0.0f)) {
      throw std::invalid_argument(fmt::format("there is nothing to erode: the largest value is {}", peak_));
    }
  }

  float operator()(float value, float noise) const {
    const float result = combined(value, noise);
    return is_fog_ ? std::max(result, 0.0f) : result;
  }

 private:
  float combined(float value, float noise) const {
    switch (combine_) {
      case Combine::replace:
        return noise;
      case Combine::add:
        return value + amount_ * noise;
      case Combine::multiply:
        return value * (1.0f + amount_ * noise);
      case Combine::erode:
        return value > 0.0f ? std::max(value - amount_ * noise * (peak_ - value), 0.0f) : value;
    }
    return value;
  }

  Combine combine_;
  float amount_;
  bool is_fog_;
  float peak_ = 0.0f;
};

}  // namespace

FilledGrid fill_grid_at_points(const FloatGrid& grid, const Field<3>& field, const RestPositions* rest,
                               Progress* progress) {
  FilledGrid filled{FloatGrid::create(0.0f), {}};
  filled.grid->setTransform(grid.transform().copy());
  filled.grid->setTree(std::make_shared<FloatTree>(grid.tree(), 0.0f, openvdb::TopologyCopy()));
  Leaves leaves(filled.grid->tree());
  std::atomic<std::uint64_t> done{0};
  leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
    throw_if_cancelled(progress);
    const std::optional<RestPositions> own_rest = rest ? std::optional(*rest) : std::nullopt;
    std::vector<Vec<3>> positions;
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
      const openvdb::Vec3d world = grid.indexToWorld(voxel.getCoord());
      const Vec<3> position(world.x(), world.y(), world.z());
      positions.push_back(own_rest ? own_rest->at(position) : position);
    }
    std::vector<float> values(positions.size());
    field.evaluate({positions}, {values, {}});
    auto next = values.begin();
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) voxel.setValue(*next++);
    if (progress != nullptr) progress->advance(++done, leaves.leafCount());
  });
  filled.moments = measure(*filled.grid);
  return filled;
}

void combine_values(FloatGrid& grid, const FloatGrid& noise, const Combination& combination) {
  const Combiner combine(grid, combination);
  Leaves leaves(grid.tree());
  leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
    const FloatLeaf* const noise_leaf = noise.tree().probeConstLeaf(leaf.origin());
    if (!noise_leaf) return;  // the leaf has no active voxels
    const std::optional<GridMask> mask = combination.mask ? std::optional(*combination.mask) : std::nullopt;
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      const float result = combine(*voxel, noise_leaf->getValue(voxel.pos()));
      if (!mask) {
        voxel.setValue(result);
        continue;
      }
      const openvdb::Vec3d world = grid.indexToWorld(voxel.getCoord());
      const float factor = mask->at({world.x(), world.y(), world.z()});
      if (factor > 0.0f) voxel.setValue(factor < 1.0f ? *voxel + factor * (result - *voxel) : result);
    }
  });
}

}  // namespace solidnoise
