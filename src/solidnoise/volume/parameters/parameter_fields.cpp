#include "solidnoise/volume/parameters/parameter_fields.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "solidnoise/core/named_error.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::Vec3SGrid;

Vec3SGrid::ConstPtr read_directions(GridFile& source, const std::string& flag, Progress* progress) {
  const openvdb::GridBase::Ptr grid = read_vector_grid(source, flag, progress);
  const std::string name = fmt::format("{}: grid '{}'", source.file, grid->getName());
  if (grid->activeVoxelCount() == 0) throw std::runtime_error(name + " has no active voxels");
  as_file_error([&] { require_finite_values(*grid, name); });
  return in_single_precision(*grid);
}

}  // namespace

DirectionField::DirectionField(GridFile& source, const std::string& flag, Progress* progress)
    : grid_(read_directions(source, flag, progress)),
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

namespace {

void require_overlap_of(const openvdb::GridBase& grid, const std::string& name, const Box<3>& box) {
  const Box<3> own = world_bounds(grid);
  for (int axis = 0; axis < 3; ++axis) {
    if (own.lower[axis] <= box.upper[axis] && box.lower[axis] <= own.upper[axis]) continue;
    throw std::runtime_error(fmt::format(
        "{} lies elsewhere than the volume: {:.6g} to {:.6g} and {:.6g} to {:.6g} along {}; their "
        "transforms disagree",
        name, own.lower[axis], own.upper[axis], box.lower[axis], box.upper[axis], "xyz"[axis]));
  }
}

}  // namespace

ParameterFields::ParameterFields(const ParameterGrids& grids, Progress* progress) : grids_(grids) {
  const auto read = [=](std::optional<ParameterGrid>& source, const char* flag, const AllowedValues& range) {
    return source ? std::make_shared<ScalarField>(*source, flag, range, progress) : nullptr;
  };
  frequency_ = read(grids_.frequency, "--frequency-grid", kFrequencyRange);
  bandwidth_ = read(grids_.bandwidth, "--bandwidth-grid", kBandwidthRange);
  magnitude_ = read(grids_.magnitude, "--magnitude-grid", kMagnitudeRange);
  if (auto& source = grids_.direction)
    direction_ = std::make_shared<DirectionField>(*source, "--direction-grid", progress);
}

KernelFields ParameterFields::kernel() const {
  const auto parameter = [](const std::shared_ptr<const ScalarField>& field) {
    return field ? VaryingParameter{field, field->least(), field->greatest()} : VaryingParameter{};
  };
  return {parameter(frequency_), parameter(bandwidth_), direction_};
}

std::uint64_t ParameterFields::memory() const {
  std::uint64_t bytes = 0;
  for (const auto* field : {&frequency_, &bandwidth_, &magnitude_}) {
    if (*field) bytes += (*field)->grid().memUsage();
  }
  return direction_ ? bytes + direction_->grid().memUsage() : bytes;
}

void ParameterFields::require_overlap(const Box<3>& box) const {
  for (const auto* field : {&frequency_, &bandwidth_, &magnitude_}) {
    if (*field) require_overlap_of((*field)->grid(), (*field)->name(), box);
  }
  if (direction_) require_overlap_of(direction_->grid(), direction_->name(), box);
}

void ParameterFields::require_allowed_at(const Topology& topology) const {
  for (const auto* field : {&frequency_, &bandwidth_, &magnitude_}) {
    if (*field) (*field)->require_allowed_at(topology);
  }
}

}  // namespace solidnoise
