#include "solidnoise/volume/modify/distance_front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;

// Where the surface may be, as seen from a neighbour.
struct Axis {
  double distance = 0.0;  // of the neighbour, voxels, not negative
  Vec3d away;             // from the neighbour to the voxel
};

}  // namespace

DistanceFront::DistanceFront(const Grids& grids)
    : finder_(grids.surface),
      surface_(grids.surface.getConstAccessor()),
      known_(grids.known.getConstAccessor()),
      layer_(grids.layer),
      per_voxel_(1.0 / grids.surface.voxelSize().x()) {}

ClosestPointFinder::Foot DistanceFront::find(const Coord& voxel) const {
  return finder_.find(voxel, guess(voxel));
}

ClosestPointFinder::Guess DistanceFront::guess(const Coord& voxel) const {
  std::vector<Axis> axes;
  for (int axis = 0; axis < 3; ++axis) {
    std::optional<Axis> nearest;
    for (const int side : {-1, 1}) {
      Coord next = voxel;
      next[axis] += side;
      float value = 0.0f;
      if (layer_.isValueOn(next) || !known_.probeValue(next, value)) continue;
      const double distance = per_voxel_ * std::abs(static_cast<double>(value));
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
    const double distance = axes[count - 1].distance;
    if (count > 1 && distance >= solution) break;
    sum += distance;
    squares += distance * distance;
    const double n = static_cast<double>(count);
    solution = (sum + std::sqrt(std::max(0.0, sum * sum - n * (squares - 1.0)))) / n;
    slope = Vec3d(0.0);
    for (std::size_t i = 0; i < count; ++i) slope += (solution - axes[i].distance) * axes[i].away;
  }
  const double sign = surface_.getValue(voxel) < 0.0f ? -1.0 : 1.0;
  return {voxel.asVec3d() - solution * slope.unitSafe(), sign * solution};
}

}  // namespace solidnoise
