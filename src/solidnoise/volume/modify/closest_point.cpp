#include "solidnoise/volume/modify/closest_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;

// Where there is no slope, any direction is as good.
Vec3d unit_or_zero(const Vec3d& vector) {
  const double length = vector.length();
  return length > 1e-9 ? vector / length : Vec3d(0.0);
}

}  // namespace

ClosestPointFinder::ClosestPointFinder(const openvdb::FloatGrid& surface)
    : values_(surface.getConstAccessor()), per_voxel_(1.0 / surface.voxelSize().x()) {}

ClosestPointFinder::Guess ClosestPointFinder::guess(const Coord& voxel) const {
  Vec3d slope;
  for (int axis = 0; axis < 3; ++axis) {
    Coord next = voxel;
    Coord last = voxel;
    ++next[axis];
    --last[axis];
    slope[axis] = static_cast<double>(values_.getValue(next)) - static_cast<double>(values_.getValue(last));
  }
  const double distance = per_voxel_ * static_cast<double>(values_.getValue(voxel));
  return {voxel.asVec3d() - distance * unit_or_zero(slope), distance};
}

ClosestPointFinder::Foot ClosestPointFinder::find(const Coord& voxel, const Guess& guess) const {
  // The error of p along the surface is multiplied by 1 - d (1 + k), k = distance x curvature, in each step:
  // this one settles for k from -1, the centre of a hollow, to 1.8.
  constexpr double kStep = 0.7;
  constexpr int kMostSteps = 12;
  constexpr double kSmallEnough = 0.05;  // voxels
  constexpr double kOnSurface = 0.1;     // voxels, before the last projection
  constexpr double kFarthestOff = 2.0;   // voxels
  const Vec3d from = voxel.asVec3d();
  Vec3d point = guess.point;
  Sample here = sample(point);
  point -= here.value * here.normal;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3d way = from - point;
    const Vec3d along = way - way.dot(here.normal) * here.normal;
    if (along.lengthSqr() < kSmallEnough * kSmallEnough && std::abs(here.value) < kOnSurface) break;
    point += kStep * along;
    here = sample(point);
    point -= here.value * here.normal;
  }
  // Where the surface bends too much for it, or the distance has no slope, the guess must do.
  const double length = (from - point).length();
  const bool settled =
      std::abs(here.value) < kOnSurface && std::abs(length - std::abs(guess.distance)) < kFarthestOff;
  if (!settled) return {guess.point, guess.distance};
  return {point, guess.distance < 0.0 ? -length : length};
}

ClosestPointFinder::Sample ClosestPointFinder::sample(const Vec3d& point) const {
  Coord corner;
  double weight[3][2];
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = std::floor(point[axis]);
    corner[axis] = static_cast<int>(lower);
    weight[axis][1] = point[axis] - lower;
    weight[axis][0] = 1.0 - weight[axis][1];
  }
  // The 2 x 2 x 2 values around the point, and on each axis those before and after them.
  double block[4][4][4];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const int outer = (i == 0 || i == 3) + (j == 0 || j == 3);
      if (outer == 0) read_row(corner.offsetBy(i - 1, j - 1, -1), std::span(block[i][j], 4));
      if (outer == 1) read_row(corner.offsetBy(i - 1, j - 1, 0), std::span(block[i][j] + 1, 2));
    }
  }
  double value = 0.0;
  Vec3d slope(0.0);
  for (int i = 1; i < 3; ++i) {
    for (int j = 1; j < 3; ++j) {
      for (int k = 1; k < 3; ++k) {
        const double w = weight[0][i - 1] * weight[1][j - 1] * weight[2][k - 1];
        value += w * block[i][j][k];
        slope += w * Vec3d(block[i + 1][j][k] - block[i - 1][j][k], block[i][j + 1][k] - block[i][j - 1][k],
                           block[i][j][k + 1] - block[i][j][k - 1]);
      }
    }
  }
  // Values that are no distances are about their slope times one.
  constexpr double kLeastSlope = 0.5;
  const double steepness = std::max(0.5 * per_voxel_ * slope.length(), kLeastSlope);
  return {per_voxel_ * value / steepness, unit_or_zero(slope)};
}

void ClosestPointFinder::read_row(const Coord& first, std::span<double> row) const {
  using Leaf = openvdb::FloatTree::LeafNodeType;
  const auto count = static_cast<unsigned>(row.size());
  const Leaf* const leaf = values_.probeConstLeaf(first);
  if (leaf != nullptr && (first.z() & (Leaf::DIM - 1)) + count <= Leaf::DIM) {
    const float* const values = leaf->buffer().data() + Leaf::coordToOffset(first);
    for (unsigned i = 0; i < count; ++i) row[i] = values[i];
    return;
  }
  for (unsigned i = 0; i < count; ++i) row[i] = values_.getValue(first.offsetBy(0, 0, static_cast<int>(i)));
}

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
