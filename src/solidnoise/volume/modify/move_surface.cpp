#include "solidnoise/volume/modify/move_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>

#include "solidnoise/volume/modify/closest_point.h"

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
using MaskLeaves = openvdb::tree::LeafManager<MaskTree>;

constexpr std::array<std::array<int, 3>, 6> kFaces{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

Coord neighbour(const Coord& voxel, const std::array<int, 3>& face) {
  return voxel.offsetBy(face[0], face[1], face[2]);
}

// A topology without what was switched off in it, leaf by leaf.
template <typename Keep>
MaskTree::Ptr select(const MaskTree& from, const Keep& keep) {
  auto result = std::make_shared<MaskTree>(from);
  MaskLeaves leaves(*result);
  leaves.foreach ([&](MaskLeaf& leaf, std::size_t) {
    const auto test = keep();
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
      if (!test(voxel.getCoord())) leaf.setValueOff(voxel.pos());
    }
  });
  openvdb::tools::pruneInactive(*result);
  return result;
}

class SurfaceMover {
 public:
  SurfaceMover(const FloatGrid& band, const PointField& noise, double amount, Progress* progress)
      : band_(band),
        noise_(noise),
        amount_(static_cast<float>(amount)),
        progress_(progress),
        voxel_(static_cast<float>(band.voxelSize().x())),
        distances_(band.deepCopy()),
        result_{band.deepCopy(), std::make_shared<MaskTree>()} {
    FloatLeaves leaves(result_.values->tree());
    leaves.foreach ([](FloatLeaf& leaf, std::size_t) { leaf.setValuesOff(); });
  }

  MovedSurface run() {
    const MaskTree all(band_.tree(), false, true, openvdb::TopologyCopy());
    MaskTree::Ptr added = select(all, [&] {
      return [this, values = band_.getConstAccessor()](const Coord& voxel) {
        return std::abs(values.getValue(voxel)) < voxel_;
      };
    });
    while (!added->empty()) {
      add(*added);
      added = next_to(*added);
    }
    keep_close_ones();
    return result_;
  }

 private:
  // Evaluates the voxels of a layer.
  void add(MaskTree& layer) {
    distances_->tree().topologyUnion(layer);
    result_.values->tree().topologyUnion(layer);
    MaskTree moved(layer);
    MaskLeaves leaves(moved);
    std::vector<float> longest(leaves.leafCount());
    leaves.foreach ([&](MaskLeaf& leaf, std::size_t index) {
      throw_if_cancelled(progress_);
      longest[index] = add(layer, leaf);
    });
    for (const float way : longest) longest_way_ = std::max(longest_way_, way);
    openvdb::tools::pruneInactive(moved);
    result_.moved->topologyUnion(moved);
  }

  // One leaf of it; leaves those voxels on whose closest point moved. Returns the longest way of them.
  float add(const MaskTree& layer, MaskLeaf& leaf) {
    const ClosestPointFinder finder(band_);
    std::vector<Vec<3>> points;
    std::vector<float> distances;
    for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
      const Coord x = voxel.getCoord();
      const auto foot =
          finder.find(x, band_.tree().isValueOn(x) ? finder.guess(x) : guess_from_known(layer, x));
      const Vec3d world = band_.indexToWorld(foot.point);
      points.emplace_back(world.x(), world.y(), world.z());
      distances.push_back(static_cast<float>(foot.distance) * voxel_);
    }
    std::vector<float> values(points.size());
    noise_.evaluate(points, values);

    FloatLeaf& known = *distances_->tree().probeLeaf(leaf.origin());
    FloatLeaf& result = *result_.values->tree().probeLeaf(leaf.origin());
    std::size_t i = 0;
    float longest = 0.0f;
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel, ++i) {
      const float way = amount_ * values[i];
      if (!band_.tree().isValueOn(voxel.getCoord())) known.setValueOnly(voxel.pos(), distances[i]);
      result.setValueOnly(voxel.pos(), distances[i] - way);
      if (way == 0.0f) leaf.setValueOff(voxel.pos());
      longest = std::max(longest, std::abs(way));
    }
    return longest;
  }

  // Solves the eikonal equation |grad s| = 1 at a voxel, by the nearest known neighbour on each axis: sums of
  // (s - s_i)^2 over the axes that make s larger than all of their s_i are 1 (Sethian 1996, the upwind scheme
  // of fast marching).
  ClosestPointFinder::Guess guess_from_known(const MaskTree& layer, const Coord& voxel) const {
    const auto known = distances_->getConstAccessor();
    const double sign = known.getValue(voxel) < 0.0f ? -1.0 : 1.0;
    struct Axis {
      double distance;  // voxels, positive
      Vec3d away;       // from the neighbour
    };
    std::vector<Axis> axes;
    for (std::size_t pair = 0; pair < kFaces.size(); pair += 2) {
      std::optional<Axis> nearest;
      for (std::size_t face = pair; face < pair + 2; ++face) {
        const Coord next = neighbour(voxel, kFaces[face]);
        if (!known.isValueOn(next) || (layer.isValueOn(next) && !band_.tree().isValueOn(next))) continue;
        const double distance = std::abs(static_cast<double>(known.getValue(next))) / voxel_;
        if (!nearest || distance < nearest->distance) nearest = {distance, (voxel - next).asVec3d()};
      }
      if (nearest) axes.push_back(*nearest);
    }
    std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.distance < b.distance; });
    double solution = 0.0;
    Vec3d slope(0.0);
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t count = 1; count <= axes.size(); ++count) {
      if (count > 1 && axes[count - 1].distance >= solution) break;
      sum += axes[count - 1].distance;
      squares += axes[count - 1].distance * axes[count - 1].distance;
      const double n = static_cast<double>(count);
      solution = (sum + std::sqrt(std::max(0.0, sum * sum - n * (squares - 1.0)))) / n;
      slope = Vec3d(0.0);
      for (std::size_t i = 0; i < count; ++i) slope += (solution - axes[i].distance) * axes[i].away;
    }
    return {voxel.asVec3d() - solution * slope.unitSafe(), sign * solution};
  }

  // What comes after a layer: the neighbours of its voxels that are close to the moved surface or on the way
  // to it, which is where they are on another side than their neighbours were.
  MaskTree::Ptr next_to(const MaskTree& layer) {
    const MaskTree::Ptr next = select(layer, [&] {
      return [this, values = result_.values->getConstAccessor(),
              distances = distances_->getConstAccessor()](const Coord& voxel) {
        const float value = values.getValue(voxel);
        if (std::abs(value) < kClose * voxel_) return true;
        if (std::abs(distances.getValue(voxel)) > longest_way_ + kClose * voxel_) return false;
        return std::any_of(kFaces.begin(), kFaces.end(), [&](const auto& face) {
          const Coord other = neighbour(voxel, face);
          return !values.isValueOn(other) && (distances.getValue(other) < 0.0f) != (value < 0.0f);
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
    const MaskTree all(grid.tree(), false, true, openvdb::TopologyCopy());
    const MaskTree::Ptr close = select(all, [&] {
      return [this, values = grid.getConstAccessor()](const Coord& voxel) {
        const float value = values.getValue(voxel);
        if (std::abs(value) < kClose * voxel_) return true;
        return std::any_of(kFaces.begin(), kFaces.end(), [&](const auto& face) {
          const Coord other = neighbour(voxel, face);
          return values.isValueOn(other) && (values.getValue(other) < 0.0f) != (value < 0.0f);
        });
      };
    });
    const float background = grid.background();
    FloatLeaves leaves(grid.tree());
    leaves.foreach ([&](FloatLeaf& leaf, std::size_t) {
      const MaskLeaf* const kept = close->probeConstLeaf(leaf.origin());
      for (unsigned voxel = 0; voxel < FloatLeaf::SIZE; ++voxel) {
        if (kept != nullptr && kept->isValueOn(voxel)) continue;
        leaf.setValueOff(voxel, std::copysign(background, leaf.getValue(voxel)));
      }
    });
    openvdb::tools::pruneLevelSet(grid.tree());
  }

  // Voxels this near to the moved surface, by phi', are always made.
  static constexpr float kClose = 2.0f;

  const FloatGrid& band_;
  const PointField& noise_;
  const float amount_;
  Progress* const progress_;
  const float voxel_;
  FloatGrid::Ptr distances_;  // active where they are known
  MovedSurface result_;
  float longest_way_ = 0.0f;
};

}  // namespace

MovedSurface move_surface(const FloatGrid& band, const PointField& noise, double amount, Progress* progress) {
  return SurfaceMover(band, noise, amount, progress).run();
}

}  // namespace solidnoise
