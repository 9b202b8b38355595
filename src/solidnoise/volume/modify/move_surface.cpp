#include "solidnoise/volume/modify/move_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

#include "solidnoise/volume/modify/closest_point.h"
#include "solidnoise/volume/modify/select_voxels.h"

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::FloatTree;
using openvdb::MaskTree;
using openvdb::Vec3d;
using FloatLeaf = FloatTree::LeafNodeType;
using MaskLeaf = MaskTree::LeafNodeType;
using FloatLeaves = openvdb::tree::LeafManager<FloatTree>;

// Voxels this near to the moved surface, by phi', are always made.
constexpr float kClose = 2.0f;

// What the finding of closest points on the moved surface looks at around voxels beside it.
void dilate_for_stencils(MaskTree& mask) {
  openvdb::tools::dilateActiveValues(mask, 2, openvdb::tools::NN_FACE_EDGE, openvdb::tools::IGNORE_TILES);
}

class SurfaceMover {
 public:
  SurfaceMover(const FloatGrid& band, const Field<3>& noise, double amount, Progress* progress)
      : band_(band),
        noise_(noise),
        amount_(static_cast<float>(amount)),
        progress_(progress),
        voxel_(static_cast<float>(band.voxelSize().x())),
        beyond_(FloatGrid::create(band.background())),
        feet_(openvdb::Vec3SGrid::create()),
        result_{band.deepCopy(), std::make_shared<MaskTree>()} {
    beyond_->setTransform(band.transform().copy());
    FloatLeaves leaves(result_.values->tree());
    leaves.foreach ([](FloatLeaf& leaf, std::size_t) { leaf.setValuesOff(); });
  }

  MovedSurface run() {
    const MaskTree all(band_.tree(), false, true, openvdb::TopologyCopy());
    grow(select_voxels(all, progress_, [&] {
      return [this, values = band_.getConstAccessor()](const Coord& voxel) {
        return std::abs(values.getValue(voxel)) < voxel_;
      };
    }));
    complete_stencils();
    keep_close_ones();
    return result_;
  }

 private:
  // Evaluates voxels, and those that they lead to.
  void grow(MaskTree::Ptr added) {
    while (!added->empty()) {
      add(*added);
      tell_progress();
      added = next_to(*added);
    }
  }

  // Evaluates what is around the zeros and was not on the way.
  void complete_stencils() {
    const MaskTree::Ptr missing = voxels_beside_zeros(*result_.values, progress_);
    dilate_for_stencils(*missing);
    while (true) {
      missing->topologyDifference(result_.values->tree());
      const MaskTree::Ptr next = select_voxels(*missing, progress_, [&] {
        return [band = band_.getConstAccessor(), beyond = beyond_->getConstAccessor()](const Coord& voxel) {
          const auto others = face_neighbours(voxel);
          return band.isValueOn(voxel) || std::any_of(others.begin(), others.end(), [&](const Coord& other) {
                   return band.isValueOn(other) || beyond.isValueOn(other);
                 });
        };
      });
      if (next->empty()) return;
      grow(next);
    }
  }

  // Evaluates the voxels of a layer.
  void add(MaskTree& layer) {
    MaskTree outside(layer);
    outside.topologyDifference(band_.tree());
    beyond_->tree().topologyUnion(outside);
    feet_->tree().topologyUnion(outside);
    result_.values->tree().topologyUnion(layer);
    MaskTree moved(layer);
    std::vector<MaskLeaf*> leaves;
    moved.getNodes(leaves);
    std::vector<float> longest(leaves.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t index) {
      throw_if_cancelled(progress_);
      longest[index] = add(layer, *leaves[index]);
    });
    for (const float way : longest) longest_way_ = std::max(longest_way_, way);
    openvdb::tools::pruneInactive(moved);
    result_.moved->topologyUnion(moved);
  }

  // One leaf of it; leaves those voxels on whose closest point moved. Returns the longest way of them.
  float add(const MaskTree& layer, MaskLeaf& leaf) {
    const ClosestPointFinder finder(band_);
    const auto band = band_.getConstAccessor();
    FloatLeaf* const beyond = beyond_->tree().probeLeaf(leaf.origin());
    openvdb::Vec3STree::LeafNodeType* const feet = feet_->tree().probeLeaf(leaf.origin());
    std::vector<Vec<3>> points;
    std::vector<float> distances;
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
      const Coord x = voxel.getCoord();
      const bool in_band = band.isValueOn(x);
      const auto foot =
          in_band ? finder.find(x, finder.guess(x)) : finder.find(x, guess_beyond(finder, layer, x));
      const Vec3d world = band_.indexToWorld(foot.point);
      points.emplace_back(world.x(), world.y(), world.z());
      distances.push_back(static_cast<float>(foot.distance) * voxel_);
      if (!in_band) {
        beyond->setValueOnly(voxel.pos(), distances.back());
        feet->setValueOnly(voxel.pos(), openvdb::Vec3s(foot.point));
      }
    }
    std::vector<float> values(points.size());
    noise_.evaluate({points}, {values, {}});

    FloatLeaf& result = *result_.values->tree().probeLeaf(leaf.origin());
    std::size_t i = 0;
    float longest = 0.0f;
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel, ++i) {
      const float way = amount_ * values[i];
      result.setValueOnly(voxel.pos(), distances[i] - way);
      if (way == 0.0f) leaf.setValueOff(voxel.pos());
      longest = std::max(longest, std::abs(way));
    }
    return longest;
  }

  // The closest point of that neighbour of earlier layers whose closest point is nearest. It lies on the
  // surface, which the way back along the distances' slope may miss where few neighbours are known, as on a
  // thin spike.
  ClosestPointFinder::Guess guess_beyond(const ClosestPointFinder& finder, const MaskTree& layer,
                                         const Coord& voxel) const {
    ClosestPointFinder::Guess nearest{voxel.asVec3d(), HUGE_VAL};
    for (const Coord& next : face_neighbours(voxel)) {
      Vec3d point;
      if (band_.tree().isValueOn(next)) {
        point = finder.guess(next).point;
      } else if (feet_->tree().isValueOn(next) && !layer.isValueOn(next)) {
        point = Vec3d(feet_->tree().getValue(next));
      } else {
        continue;
      }
      const double distance = (voxel.asVec3d() - point).length();
      if (distance < nearest.distance) nearest = {point, distance};
    }
    if (band_.tree().getValue(voxel) < 0.0f) nearest.distance = -nearest.distance;
    return nearest;
  }

  // The layers that are to come are those of the longest way so far, and fewer and fewer voxels go so far.
  void tell_progress() {
    ++layers_;
    if (progress_ == nullptr) return;
    const double most = layers_ + kClose + longest_way_ / voxel_;
    const double left = 1.0 - layers_ / most;
    constexpr double kUnits = 1000.0;
    progress_->advance(static_cast<std::uint64_t>(kUnits * (1.0 - left * left)),
                       static_cast<std::uint64_t>(kUnits));
  }

  // What comes after a layer: the neighbours of its voxels that are close to the moved surface or on the way
  // to it, which is where they are on another side than their neighbours were.
  MaskTree::Ptr next_to(const MaskTree& layer) {
    const MaskTree::Ptr next = select_voxels(layer, progress_, [&] {
      return [this, values = result_.values->getConstAccessor(), band = band_.getConstAccessor(),
              beyond = beyond_->getConstAccessor()](const Coord& voxel) {
        const float value = values.getValue(voxel);
        if (std::abs(value) < kClose * voxel_) return true;
        float distance = 0.0f;
        if (!band.probeValue(voxel, distance)) distance = beyond.getValue(voxel);
        if (std::abs(distance) > longest_way_ + kClose * voxel_) return false;
        const auto others = face_neighbours(voxel);
        return std::any_of(others.begin(), others.end(), [&](const Coord& other) {
          return !values.isValueOn(other) && (band.getValue(other) < 0.0f) != (value < 0.0f);
        });
      };
    });
    openvdb::tools::dilateActiveValues(*next, 1, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
    next->topologyDifference(result_.values->tree());
    openvdb::tools::pruneInactive(*next);
    return next;
  }

  // Switches off voxels that were on the way only.
  void keep_close_ones() {
    FloatGrid& grid = *result_.values;
    const MaskTree::Ptr close = voxels_beside_zeros(grid, progress_);
    dilate_for_stencils(*close);
    const float background = grid.background();
    FloatLeaves leaves(grid.tree());
    leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
      const MaskLeaf* const kept = close->probeConstLeaf(leaf.origin());
      for (unsigned voxel = 0; voxel < FloatLeaf::SIZE; ++voxel) {
        if (kept != nullptr && kept->isValueOn(voxel) && leaf.isValueOn(voxel)) continue;
        leaf.setValueOff(voxel, std::copysign(background, leaf.getValue(voxel)));
      }
    });
    openvdb::tools::pruneLevelSet(grid.tree());
  }

  const FloatGrid& band_;
  const Field<3>& noise_;
  const float amount_;
  Progress* const progress_;
  const float voxel_;
  FloatGrid::Ptr beyond_;         // distances where the band is not
  openvdb::Vec3SGrid::Ptr feet_;  // and the closest points, in index space
  MovedSurface result_;
  float longest_way_ = 0.0f;
  int layers_ = 0;
};

}  // namespace

MovedSurface move_surface(const FloatGrid& band, const Field<3>& noise, double amount, Progress* progress) {
  return SurfaceMover(band, noise, amount, progress).run();
}

}  // namespace solidnoise
