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
  if (auto& source = grids_.frequency) frequency_.emplace(*source, "--frequency-grid", kFrequencyRange);
  if (auto& source = grids_.bandwidth) bandwidth_.emplace(*source, "--bandwidth-grid", kBandwidthRange);
  if (auto& source = grids_.magnitude) magnitude_.emplace(*source, "--magnitude-grid", kMagnitudeRange);
  if (auto& source = grids_.direction) direction_.emplace(*source, "--direction-grid");
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
