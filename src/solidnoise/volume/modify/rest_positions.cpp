#include "solidnoise/volume/modify/rest_positions.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/volume/vdb/require_finite_grid.h"
#include "solidnoise/volume/vdb/single_precision.h"

namespace solidnoise {
namespace {

using openvdb::Vec3SGrid;

// The precision in which noise takes positions within a leaf.
Vec3SGrid::ConstPtr read_vectors(const openvdb::GridBase& grid, const std::string& name) {
  require_finite_values(grid, name);
  if (Vec3SGrid::ConstPtr vectors = in_single_precision(grid)) return vectors;
  throw std::invalid_argument(
      fmt::format("{} is of type {}; rest positions must be of vec3s or vec3d", name, grid.valueType()));
}

}  // namespace

RestPositions::RestPositions(const openvdb::GridBase& grid, const std::string& name)
    : name_(name), values_(read_vectors(grid, name)), accessor_(values_->getConstAccessor()) {}

Vec<3> RestPositions::at(const Vec<3>& world) const {
  constexpr double kLeastWeight = 1e-6;  // what rounding may leave of a voxel next to the one that is meant
  const openvdb::Vec3d index = values_->worldToIndex({world.x, world.y, world.z});
  openvdb::Coord corner;
  double fraction[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = std::floor(index[axis]);
    corner[axis] = static_cast<int>(lower);
    fraction[axis] = index[axis] - lower;
  }
  Vec<3> sum(0.0);
  double total = 0.0;
  for (int i = 0; i < 8; ++i) {
    double weight = 1.0;
    openvdb::Coord voxel = corner;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = (i >> axis & 1) != 0;
      voxel[axis] += upper;
      weight *= upper ? fraction[axis] : 1.0 - fraction[axis];
    }
    openvdb::Vec3s value;
    if (weight < kLeastWeight || !accessor_.probeValue(voxel, value)) continue;
    sum += weight * Vec<3>(value.x(), value.y(), value.z());
    total += weight;
  }
  if (total == 0.0) {
    throw std::runtime_error(
        fmt::format("{} has no rest position at ({:.6g}, {:.6g}, {:.6g}), where the other grid has a value",
                    name_, world.x, world.y, world.z));
  }
  return sum / total;
}

}  // namespace solidnoise
