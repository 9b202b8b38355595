#include "solidnoise/volume/modify/modify_volume.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <openvdb/tools/Prune.h>

#include "solidnoise/core/named_error.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/volume/modify/combine.h"
#include "solidnoise/volume/modify/displace_level_set.h"
#include "solidnoise/volume/modify/grid_lookup.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;
using openvdb::GridBase;

// "in.vdb: grid 'density'", the beginning of a message.
std::string name_of(const GridFile& source, const GridBase& grid) {
  return fmt::format("{}: grid '{}'", source.file, grid.getName());
}

void require_suitable(const Modification& modification, const FloatGrid& grid) {
  const std::string name = name_of(modification.on, grid);
  if (grid.activeVoxelCount() == 0) throw std::runtime_error(name + " has no active voxels");
  const bool is_level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  if (modification.displace && !is_level_set) {
    throw std::runtime_error(
        fmt::format("{} is of class {}; --displace moves the surface of a level set: use --combine", name,
                    GridBase::gridClassToString(grid.getGridClass())));
  }
  if (!modification.displace && is_level_set) {
    throw std::runtime_error(
        name + " is a level set, whose distances --combine would spoil; --displace AMOUNT moves its surface");
  }
  if (is_level_set && !grid.hasUniformVoxels()) {
    throw std::runtime_error(name + " has voxels that are no cubes; the level set cannot be displaced");
  }
  if (is_level_set && !(grid.background() >= 2.0 * grid.voxelSize().x())) {
    throw std::runtime_error(
        fmt::format("{} has a background of {}; a level set's must be at least 2 voxels, {}", name,
                    grid.background(), 2.0 * grid.voxelSize().x()));
  }
  as_file_error([&] { require_finite_values(grid, name); });
}

void require_overlap(const GridFile& source, const GridBase& grid, const GridBase& target) {
  const Box<3> a = world_bounds(grid);
  const Box<3> b = world_bounds(target);
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] <= b.upper[axis] && b.lower[axis] <= a.upper[axis]) continue;
    throw std::runtime_error(
        fmt::format("{} lies elsewhere than grid '{}': {:.6g} to {:.6g} and {:.6g} to {:.6g} along {}; their "
                    "transforms disagree",
                    name_of(source, grid), target.getName(), a.lower[axis], a.upper[axis], b.lower[axis],
                    b.upper[axis], "xyz"[axis]));
  }
}

// The field at rest positions, times the mask.
class ModifyingField final : public PointwiseField {
 public:
  ModifyingField(FieldPtr field, std::optional<GridMask> mask, std::optional<RestPositions> rest)
      : field_(std::move(field)), mask_(std::move(mask)), rest_(std::move(rest)) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    std::vector<Vec<3>> looked_up(points.positions.begin(), points.positions.end());
    if (rest_) {
      const RestPositions rest = *rest_;
      for (Vec<3>& position : looked_up) position = rest.at(position);
    }
    field_->evaluate({looked_up}, samples);
    if (!mask_) return;
    const GridMask mask = *mask_;
    for (std::size_t i = 0; i < points.size(); ++i) samples.values[i] *= mask.at(points.positions[i]);
  }

 private:
  FieldPtr field_;
  std::optional<GridMask> mask_;
  std::optional<RestPositions> rest_;
};

std::optional<GridMask> make_mask(const ModificationPlan& plan) {
  if (!plan.mask) return std::nullopt;
  return as_file_error([&] { return GridMask(*plan.mask, name_of(*plan.modification.mask, *plan.mask)); });
}

std::optional<RestPositions> make_rest(const ModificationPlan& plan) {
  if (!plan.rest) return std::nullopt;
  return as_file_error(
      [&] { return RestPositions(*plan.rest, name_of(*plan.modification.rest, *plan.rest)); });
}

// The grid without active tiles.
FloatGrid::Ptr voxelized_copy(const FloatGrid& grid) {
  FloatGrid::Ptr copy = grid.deepCopy();
  copy->tree().voxelizeActiveTiles();
  return copy;
}

}  // namespace

const FloatGrid& ModificationPlan::grid() const {
  return static_cast<const FloatGrid&>(*file.grids[target]);
}

std::optional<GridFrame> ModificationPlan::frame() const {
  try {
    return GridFrame(grid().transform());
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

bool ModificationPlan::on_lattice() const {
  return !modification.displace && !rest && frame().has_value();
}

double ModificationPlan::voxels(double frequency, double sigma) const {
  if (!modification.displace) return static_cast<double>(grid().activeVoxelCount());
  return estimate_displaced_voxels(grid(), sigma * *modification.displace, frequency);
}

std::uint64_t ModificationPlan::memory(double frequency, double sigma) const {
  std::uint64_t bytes = 0;
  for (const GridBase::Ptr& each : file.grids) bytes += each->baseTree().memUsage();
  for (const GridBase::Ptr& each : {mask, rest}) {
    if (each) bytes += 2 * each->baseTree().memUsage();
  }
  if (modification.displace) {
    return bytes + estimate_displacement_memory(grid(), sigma * *modification.displace, frequency);
  }
  constexpr std::uint64_t kCopies = 3;  // topology, noise and result
  return bytes + kCopies * estimate_memory(grid());
}

ModificationPlan plan_modification(const Modification& modification, Progress* progress) {
  modification.validate();
  if (modification.on.file.empty()) {
    throw std::invalid_argument("on is missing; it must name the grid to work on, FILE.vdb or FILE.vdb:GRID");
  }
  ModificationPlan plan;
  plan.modification = modification;
  plan.file = read_grids_around(plan.modification.on, "--on", plan.target, progress);
  require_suitable(plan.modification, plan.grid());
  if (auto& mask = plan.modification.mask) {
    plan.mask = read_grid(*mask, "--mask", progress);
    make_mask(plan);
    require_overlap(*mask, *plan.mask, plan.grid());
  }
  if (auto& rest = plan.modification.rest) {
    plan.rest = read_grid(*rest, "--rest", progress);
    make_rest(plan);
    require_overlap(*rest, *plan.rest, plan.grid());
  }
  return plan;
}

FilledGrid make_modifying_noise(const ModificationPlan& plan, const Field<3>& field, Progress* progress) {
  if (plan.on_lattice()) return fill_grid(grid_topology(plan.grid()), field, Sparsity::keep, progress);
  const std::optional<RestPositions> rest = make_rest(plan);
  return fill_grid_at_points(*voxelized_copy(plan.grid()), field, rest ? &*rest : nullptr, progress);
}

FloatGrid::Ptr combine(const ModificationPlan& plan, const FloatGrid& noise) {
  const FloatGrid::Ptr result = voxelized_copy(plan.grid());
  const std::optional<GridMask> mask = make_mask(plan);
  const Modification& modification = plan.modification;
  const Combination combination{modification.combine, modification.amount, mask ? &*mask : nullptr};
  in_file(name_of(modification.on, plan.grid()), [&] { combine_values(*result, noise, combination); });
  if (plan.grid().tree().hasActiveTiles()) openvdb::tools::prune(result->tree());
  return result;
}

FloatGrid::Ptr displace(const ModificationPlan& plan, FieldPtr noise, Progress* progress) {
  const ModifyingField field(std::move(noise), make_mask(plan), make_rest(plan));
  return in_file(name_of(plan.modification.on, plan.grid()), [&] {
    return displace_level_set(plan.grid(), field, *plan.modification.displace, progress);
  });
}

openvdb::GridPtrVec replace_target(const ModificationPlan& plan, FloatGrid::Ptr changed) {
  openvdb::GridPtrVec grids = plan.file.grids;
  grids[plan.target] = std::move(changed);
  return grids;
}

}  // namespace solidnoise
