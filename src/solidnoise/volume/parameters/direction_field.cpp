#include "solidnoise/volume/parameters/direction_field.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/volume/vdb/require_finite_grid.h"
#include "solidnoise/volume/vdb/single_precision.h"

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::Vec3SGrid;

Vec3SGrid::ConstPtr read_directions(GridFile& source, const std::string& flag) {
  const openvdb::GridBase::Ptr grid = read_vector_grid(source, flag);
  const std::string name = fmt::format("{}: grid '{}'", source.file, grid->getName());
  if (grid->activeVoxelCount() == 0) throw std::runtime_error(name + " has no active voxels");
  try {
    require_finite_values(*grid, name);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
  return in_single_precision(*grid);
}

}  // namespace

DirectionField::DirectionField(GridFile& source, const std::string& flag)
    : grid_(read_directions(source, flag)),
      name_(fmt::format("{}: grid '{}'", source.file, grid_->getName())) {}

void DirectionField::evaluate(const Points<3>& points, const Samples<3>& samples) const {
  const auto accessor = grid_->getConstUnsafeAccessor();
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Gather the eight voxels around the position.
    const Vec<3>& p = points.positions[i];
    const openvdb::Vec3d index = grid_->transform().worldToIndex(openvdb::Vec3d(p.x, p.y, p.z));
    const Coord corner = Coord::floor(index);
    const openvdb::Vec3d fraction = index - corner.asVec3d();
    std::array<openvdb::Vec3d, 8> vectors;
    std::array<double, 8> weights;
    for (std::size_t k = 0; k < 8; ++k) {
      const Coord upper(k & 1, k >> 1 & 1, k >> 2 & 1);
      weights[k] = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        weights[k] *= upper[axis] != 0 ? fraction[axis] : 1.0 - fraction[axis];
      }
      vectors[k] = openvdb::Vec3d(accessor.getValue(corner + upper));
    }
    // Turn them to the side of the nearest one, and take the mean.
    const auto nearest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    const openvdb::Vec3d side = vectors[static_cast<std::size_t>(nearest)];
    openvdb::Vec3d sum(0.0);
    for (std::size_t k = 0; k < 8; ++k) {
      sum += (vectors[k].dot(side) < 0.0 ? -weights[k] : weights[k]) * vectors[k];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      samples.values[axis * points.size() + i] = static_cast<float>(sum[static_cast<int>(axis)]);
    }
  }
}

}  // namespace solidnoise
