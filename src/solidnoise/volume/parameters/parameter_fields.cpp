#include "solidnoise/volume/parameters/parameter_fields.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "solidnoise/volume/topology/world_bounds.h"

namespace solidnoise {
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

ParameterFields::ParameterFields(const ParameterGrids& grids) : grids_(grids) {
  const auto read = [](std::optional<ParameterGrid>& source, const char* flag, const ParameterRange& range) {
    return source ? std::make_shared<ScalarField>(*source, flag, range) : nullptr;
  };
  frequency_ = read(grids_.frequency, "--frequency-grid", kFrequencyRange);
  bandwidth_ = read(grids_.bandwidth, "--bandwidth-grid", kBandwidthRange);
  magnitude_ = read(grids_.magnitude, "--magnitude-grid", kMagnitudeRange);
  if (auto& source = grids_.direction)
    direction_ = std::make_shared<DirectionField>(*source, "--direction-grid");
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
