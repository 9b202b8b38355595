#include "solidnoise/volume/modify/displace_level_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetTracker.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/modify/move_surface.h"
#include "solidnoise/volume/topology/interrupter.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;
using openvdb::FloatTree;
using openvdb::MaskTree;
using Leaf = FloatTree::LeafNodeType;
using Leaves = openvdb::tree::LeafManager<FloatTree>;

// Cuts the band to values under `background`, which takes the background's place. Tiles are not in it.
void cut_band(FloatGrid& grid, float background) {
  auto tile = grid.beginValueOn();
  tile.setMaxDepth(FloatGrid::ValueOnIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) tile.setValueOff();
  Leaves leaves(grid.tree());
  leaves.foreach ([&](Leaf& leaf, std::size_t) {
    for (auto value = leaf.beginValueOn(); value; ++value) {
      if (std::abs(*value) >= background) value.setValueOff();
    }
  });
  openvdb::tools::changeLevelSetBackground(grid.tree(), background);
  openvdb::tools::pruneLevelSet(grid.tree());
}

// Distances of the band's width from the zeros of a grid that is active close to them.
FloatGrid::Ptr measure_distances(FloatGrid::Ptr grid, float background, Progress* progress) {
  // So many of its steps reach all that is as many voxels away: along the axes, and along diagonals further.
  using openvdb::tools::NN_FACE_EDGE;
  const auto steps_to = [](double voxels) { return std::max(1, static_cast<int>(std::ceil(voxels)) - 1); };
  constexpr int kMargin = 2;  // voxels beyond the band, for what looks at neighbours
  const float voxel = static_cast<float>(grid->voxelSize().x());
  const float wide = background + kMargin * voxel;
  throw_if_cancelled(progress);
  grid = openvdb::tools::sdfToSdf(*grid);
  throw_if_cancelled(progress);
  grid = openvdb::tools::dilateSdf(*grid, steps_to(wide / voxel), NN_FACE_EDGE);
  throw_if_cancelled(progress);
  cut_band(*grid, wide);

  // Fast sweeping is exact to first order; a few steps of fifth-order normalization do the rest.
  constexpr int kSteps = 8;
  Interrupter interrupter(progress);
  openvdb::tools::LevelSetTracker<FloatGrid> tracker(*grid, &interrupter);
  tracker.setNormCount(kSteps);
  tracker.normalize();
  throw_if_cancelled(progress);
  cut_band(*grid, background);
  return grid;
}

// Puts back what was there, outside of a mask.
void restore_outside(FloatGrid& grid, const FloatGrid& original, const MaskTree& mask) {
  FloatTree& tree = grid.tree();
  for (auto leaf = original.tree().cbeginLeaf(); leaf; ++leaf) tree.touchLeaf(leaf->origin());
  Leaves leaves(tree);
  leaves.foreach ([&](Leaf& leaf, std::size_t) {
    const MaskTree::LeafNodeType* const kept = mask.probeConstLeaf(leaf.origin());
    const Leaf* const old = original.tree().probeConstLeaf(leaf.origin());
    const float tile = original.tree().getValue(leaf.origin());
    for (unsigned voxel = 0; voxel < Leaf::SIZE; ++voxel) {
      if (kept != nullptr && kept->isValueOn(voxel)) continue;
      leaf.setValueOnly(voxel, old != nullptr ? old->getValue(voxel) : tile);
      leaf.setActiveState(voxel, old != nullptr && old->isValueOn(voxel));
    }
  });
  openvdb::tools::pruneLevelSet(tree);
}

}  // namespace

FloatGrid::Ptr displace_level_set(const FloatGrid& level_set, const PointField& noise, double amount,
                                  Progress* progress) {
  require_finite("displace", amount);
  if (level_set.getGridClass() != openvdb::GRID_LEVEL_SET) {
    throw std::invalid_argument("the grid's class is not level set");
  }
  if (!level_set.hasUniformVoxels()) throw std::invalid_argument("the level set's voxels are not cubes");
  const float background = level_set.background();
  const FloatGrid::Ptr band = level_set.deepCopy();
  cut_band(*band, background);

  MovedSurface surface = move_surface(*band, noise, amount, progress);
  if (surface.moved->empty()) return level_set.deepCopy();
  const FloatGrid::Ptr result = measure_distances(std::move(surface.values), background, progress);
  const int reach = static_cast<int>(std::ceil(background / level_set.voxelSize().x())) + 3;
  openvdb::tools::dilateActiveValues(*surface.moved, reach, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::IGNORE_TILES);
  restore_outside(*result, level_set, *surface.moved);
  return result;
}

std::uint64_t estimate_displacement_memory(const FloatGrid& level_set, double farthest) {
  // Measured on spheres of 128 and 256 voxels, moved by noise of 0.3 to 40 voxels a sigma and 0.02 to 0.13
  // cycles per voxel: 110 bytes for a voxel of the band that hardly moves, and 2.5 for each voxel of the
  // longest way, rounded up.
  constexpr double kStanding = 120.0;
  constexpr double kMoving = 4.0;
  const double way = farthest / level_set.voxelSize().x();
  const double bytes = static_cast<double>(level_set.activeVoxelCount()) * (kStanding + kMoving * way);
  constexpr double kLargest = 0x1.0p63;
  return static_cast<std::uint64_t>(std::min(bytes, kLargest));
}

}  // namespace solidnoise
