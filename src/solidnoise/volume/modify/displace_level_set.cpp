#include "solidnoise/volume/modify/displace_level_set.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/LevelSetTracker.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/volume/modify/closest_point.h"
#include "solidnoise/volume/modify/move_surface.h"
#include "solidnoise/volume/modify/select_voxels.h"
#include "solidnoise/volume/topology/interrupter.h"

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::FloatTree;
using openvdb::MaskTree;
using openvdb::Vec3d;
using FloatLeaf = FloatTree::LeafNodeType;
using FloatLeaves = openvdb::tree::LeafManager<FloatTree>;
using MaskLeaf = MaskTree::LeafNodeType;

class DistanceMeasurer {
 public:
  DistanceMeasurer(const FloatGrid& values, Progress* progress)
      : values_(values),
        progress_(progress),
        voxel_(static_cast<float>(values.voxelSize().x())),
        background_(values.background()),
        result_(values.deepCopy()) {
    FloatLeaves leaves(result_->tree());
    leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
      for (unsigned voxel = 0; voxel < FloatLeaf::SIZE; ++voxel) {
        leaf.setValueOff(voxel, std::copysign(background_, leaf.getValue(voxel)));
      }
    });
  }

  FloatGrid::Ptr run() {
    MaskTree::Ptr layer = voxels_beside_zeros(values_, progress_);
    set(*layer, [&] {
      return [this, finder = ClosestPointFinder(values_), values = values_.getConstAccessor()](
                 const Coord& voxel) { return finder.find(voxel, guess_beside_zero(values, voxel)); };
    });
    // Layers cost about the same; along a diagonal there are this many.
    const auto layers = static_cast<std::uint64_t>(std::ceil(std::sqrt(3.0f) * background_ / voxel_));
    for (std::uint64_t done = 1; !layer->empty(); ++done) {
      if (progress_ != nullptr) progress_->advance(std::min(done, layers), layers);
      layer = next_to(*layer);
      set(*layer, [&] {
        return [front = DistanceFront({values_, *result_, *layer})](const Coord& voxel) {
          return front.find(voxel);
        };
      });
    }
    cut();
    return result_;
  }

 private:
  // Evaluates a layer; `make_find()` makes what finds the closest points, for each leaf.
  template <typename MakeFind>
  void set(const MaskTree& layer, const MakeFind& make_find) {
    result_->tree().topologyUnion(layer);
    std::vector<const MaskLeaf*> leaves;
    layer.getNodes(leaves);
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t index) {
      throw_if_cancelled(progress_);
      const auto find = make_find();
      FloatLeaf& result = *result_->tree().probeLeaf(leaves[index]->origin());
      for (auto voxel = leaves[index]->cbeginValueOn(); voxel; ++voxel) {
        result.setValueOnly(voxel.pos(), voxel_ * static_cast<float>(find(voxel.getCoord()).distance));
      }
    });
  }

  // On the plane through the places where the values go through 0 along the axes.
  static ClosestPointFinder::Guess guess_beside_zero(const FloatGrid::ConstAccessor& values,
                                                     const Coord& voxel) {
    const double here = values.getValue(voxel);
    if (here == 0.0) return {voxel.asVec3d(), 0.0};
    Vec3d steepness(0.0);  // 1 / way to the plane along each axis: its normal over its distance
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Coord next = voxel;
        next[axis] += side;
        const double there = values.getValue(next);
        const double per_way = (here - there) / here;
        if ((there < 0.0) != (here < 0.0) && per_way > std::abs(steepness[axis])) {
          steepness[axis] = side * per_way;
        }
      }
    }
    const double distance = 1.0 / steepness.length();
    return {voxel.asVec3d() + distance * distance * steepness, std::copysign(distance, here)};
  }

  // The neighbours of a layer's voxels in the band that have no distance yet.
  MaskTree::Ptr next_to(const MaskTree& layer) const {
    const MaskTree::Ptr next = select_voxels(layer, progress_, [&] {
      return [this, distances = result_->getConstAccessor()](const Coord& voxel) {
        return std::abs(distances.getValue(voxel)) < background_;
      };
    });
    openvdb::tools::dilateActiveValues(*next, 1, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
    next->topologyDifference(result_->tree());
    openvdb::tools::pruneInactive(*next);
    return next;
  }

  // Leaves out what is beyond the band.
  void cut() {
    FloatLeaves leaves(result_->tree());
    leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
      for (auto value = leaf.beginValueOn(); value; ++value) {
        if (std::abs(*value) >= background_)
          leaf.setValueOff(value.pos(), std::copysign(background_, *value));
      }
    });
    openvdb::tools::pruneLevelSet(result_->tree());
  }

  const FloatGrid& values_;
  Progress* const progress_;
  const float voxel_;
  const float background_;
  FloatGrid::Ptr result_;
};

// A level set of the zeros of `values`, in a band as wide as the background of that, in its frame. Cubic
// voxels; any values that have a slope at their zeros, active at least two voxels (to faces and edges) around
// each voxel that has one of the other side beside it, and everywhere of the right sign.
//
// Each voxel takes the distance to its closest point, found as by ClosestPointFinder, layer by layer from the
// zeros on; OpenVDB's LevelSetTracker then makes |gradient| 1 where that cannot be, around details of the
// size of a voxel. In parallel; the same to the last bit for any number of threads. Throws Cancelled.
FloatGrid::Ptr measure_distances(const FloatGrid& values, Progress* progress) {
  constexpr double kMeasured = 0.7;  // share of the time
  constexpr int kSteps = 3;
  PartialProgress measuring(progress, 0.0, kMeasured);
  const FloatGrid::Ptr grid = DistanceMeasurer(values, &measuring).run();

  PartialProgress normalizing(progress, kMeasured, 1.0);
  Interrupter interrupter(&normalizing, kSteps);
  openvdb::tools::LevelSetTracker<FloatGrid> tracker(*grid, &interrupter);
  tracker.setNormCount(kSteps);
  tracker.normalize();
  throw_if_cancelled(progress);
  tracker.prune();
  return grid;
}

using Leaves = openvdb::tree::LeafManager<FloatTree>;

// Cuts the band to values under `background`, which takes the background's place. Tiles are not in it.
void cut_band(FloatGrid& grid, float background) {
  auto tile = grid.beginValueOn();
  tile.setMaxDepth(FloatGrid::ValueOnIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) tile.setValueOff();
  Leaves leaves(grid.tree());
  leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
    for (auto value = leaf.beginValueOn(); value; ++value) {
      if (std::abs(*value) >= background) value.setValueOff();
    }
  });
  openvdb::tools::changeLevelSetBackground(grid.tree(), background);
  openvdb::tools::pruneLevelSet(grid.tree());
}

// Whether a level set has nothing that cut_band would change.
bool is_cut(const FloatGrid& grid) {
  if (grid.tree().hasActiveTiles()) return false;
  const float background = grid.background();
  std::atomic<bool> cut{true};
  openvdb::tree::LeafManager<const FloatTree> leaves(grid.tree());
  leaves.foreach ([&](const FloatLeaf& leaf, std::size_t) {
    for (unsigned voxel = 0; voxel < FloatLeaf::SIZE; ++voxel) {
      const float size = std::abs(leaf.getValue(voxel));
      if (leaf.isValueOn(voxel) ? !(size < background) : size != background) cut = false;
    }
  });
  return cut;
}

// Puts back what was there, outside of a mask.
void restore_outside(FloatGrid& grid, const FloatGrid& original, const MaskTree& mask) {
  FloatTree& tree = grid.tree();
  for (auto leaf = original.tree().cbeginLeaf(); leaf; ++leaf) tree.touchLeaf(leaf->origin());
  Leaves leaves(tree);
  leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
    const MaskTree::LeafNodeType* const kept = mask.probeConstLeaf(leaf.origin());
    const FloatLeaf* const old = original.tree().probeConstLeaf(leaf.origin());
    const float tile = original.tree().getValue(leaf.origin());
    for (unsigned voxel = 0; voxel < FloatLeaf::SIZE; ++voxel) {
      if (kept != nullptr && kept->isValueOn(voxel)) continue;
      leaf.setValueOnly(voxel, old != nullptr ? old->getValue(voxel) : tile);
      leaf.setActiveState(voxel, old != nullptr && old->isValueOn(voxel));
    }
  });
  openvdb::tools::pruneLevelSet(tree);
}

}  // namespace

FloatGrid::Ptr displace_level_set(const FloatGrid& level_set, const Field<3>& noise, double amount,
                                  Progress* progress) {
  require_finite("displace", amount);
  if (level_set.getGridClass() != openvdb::GRID_LEVEL_SET) {
    throw std::invalid_argument("the grid's class is not level set");
  }
  if (!level_set.hasUniformVoxels()) throw std::invalid_argument("the level set's voxels are not cubes");
  FloatGrid::ConstPtr band = level_set.copy();
  if (!is_cut(level_set)) {
    const FloatGrid::Ptr copy = level_set.deepCopy();
    cut_band(*copy, level_set.background());
    band = copy;
  }
  constexpr double kMoved = 0.5;  // share of the time
  PartialProgress moving(progress, 0.0, kMoved);
  PartialProgress measuring(progress, kMoved, 1.0);
  MovedSurface surface = move_surface(*band, noise, amount, &moving);
  band.reset();
  if (surface.moved->empty()) return level_set.deepCopy();
  const FloatGrid::Ptr result = measure_distances(*surface.values, &measuring);
  surface.values.reset();
  const int reach = static_cast<int>(std::ceil(level_set.background() / level_set.voxelSize().x())) + 3;
  for (int step = 0; step < reach; ++step) {
    throw_if_cancelled(progress);
    openvdb::tools::dilateActiveValues(*surface.moved, 1, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                       openvdb::tools::IGNORE_TILES);
  }
  restore_outside(*result, level_set, *surface.moved);
  return result;
}

namespace {

// A level set's surface, and how noise changes it, in the forms of estimate_displaced_voxels().
struct MovedSize {
  double area;     // voxels
  double stretch;  // of the area
  double slope;    // area of the surface in the noise, over that without
  double sigma;    // voxels

  MovedSize(const FloatGrid& level_set, double amount, double frequency) {
    const double voxel = level_set.voxelSize().x();
    const double band = 2.0 * level_set.background() / voxel;
    sigma = std::abs(amount) / voxel;
    area = static_cast<double>(level_set.activeVoxelCount()) / band;
    const double radius = std::sqrt(area / (4.0 * kPi));
    const double along = 1.0 + (area > 0.0 ? 2.0 * sigma / radius : 0.0);
    stretch = along * along;
    const double steepness = 2.0 * kPi * frequency * std::abs(amount);
    slope = std::sqrt(1.0 + kPi / 4.0 * 2.0 / 3.0 * steepness * steepness);
  }

  // Of a band so many voxels wide, those that are new.
  double new_voxels(double band) const {
    constexpr double kSwept = 4.0;  // sigmas, from side to side
    const double folded = band * (slope - 1.0);
    const double room = kSwept * sigma;
    const double fold = folded > 0.0 ? 1.0 / (1.0 / folded + 1.0 / room) : 0.0;
    return area * (stretch * (band + fold) - band);
  }
};

}  // namespace

double estimate_displaced_voxels(const FloatGrid& level_set, double amount, double frequency) {
  const double band = 2.0 * level_set.background() / level_set.voxelSize().x();
  return static_cast<double>(level_set.activeVoxelCount()) +
         MovedSize(level_set, amount, frequency).new_voxels(band);
}

std::uint64_t estimate_displacement_memory(const FloatGrid& level_set, double amount, double frequency) {
  // The most is taken as the surface moves, whatever the band is, but for copies of that. Measured on a torus
  // of 64 to 640 voxels in bands of 3 to 34, moved by .002 to .5 of its radii in waves of .2 to .016 of them:
  // .4 to .9 of this are taken, with the program's.
  constexpr double kAtLeast = 16.0 * 0x1p20;
  constexpr double kAtSurface = 350.0;
  constexpr double kOnTheWay = 20.0;  // for each sigma
  constexpr double kInBand = 5.0;
  constexpr double kNew = 30.0;
  constexpr double kBand = 6.0;  // voxels that are made around the moved surface
  const MovedSize moved(level_set, amount, frequency);
  const double bytes = kAtLeast + kInBand * static_cast<double>(level_set.activeVoxelCount()) +
                       moved.area * moved.stretch * (kAtSurface + kOnTheWay * moved.sigma) +
                       kNew * moved.new_voxels(kBand);
  constexpr double kLargest = 0x1.0p63;
  return static_cast<std::uint64_t>(std::min(bytes, kLargest));
}

}  // namespace solidnoise
