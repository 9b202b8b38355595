#include "solidnoise/volume/make_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/named_error.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/modified_volume.h"
#include "solidnoise/volume/shape_cover.h"
#include "solidnoise/volume/shape_field.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/volume_field.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

// Takes place and voxels of the grid that is modified.
void plan_modification(const VolumeRecipe& recipe, VolumePlan& plan, Progress* progress) {
  if (!plan.part.whole()) {
    throw std::invalid_argument("a grid that exists is worked on as a whole; leave out region and shard");
  }
  ModificationPlan modification = plan_modification(recipe, progress);
  const openvdb::FloatGrid& grid = modification.grid();
  plan.voxels = grid.evalActiveVoxelBoundingBox();
  const openvdb::Vec3d size = grid.transform().voxelSize(plan.voxels.getCenter());
  plan.frame = modification.frame().value_or(GridFrame(std::max({size.x(), size.y(), size.z()})));
  plan.box = plan.frame.bounds(plan.voxels);
  plan.memory = estimate_memory(recipe, modification);
  plan.modification = std::move(modification);
}

// Reads the surface that a velocity is to stay off, if there is one.
VolumePlan::GridBoundary plan_boundary(const VolumeRecipe& recipe, Progress* progress) {
  VolumePlan::GridBoundary plan{recipe.boundary, nullptr};
  if (!plan.boundary) return plan;
  const openvdb::FloatGrid::Ptr surface = read_float_grid(*plan.boundary, "--boundary", progress);
  in_file(plan.boundary->file, [&] { require_level_set(*surface); });
  const double frequency = std::visit([](const auto& noise) { return noise.frequency; }, recipe.noise.noise);
  plan.distance = std::make_shared<PlannedDistance>(surface, recipe.boundary_width.value_or(1.0 / frequency));
  return plan;
}

// All of the plan but the parameters.
VolumePlan plan_voxels(const VolumeRecipe& recipe, const VolumePart& part, Progress* progress) {
  VolumePlan plan;
  plan.part = part;
  plan.box = recipe.box;
  plan.shape = recipe.shape;
  if (recipe.modification) {
    plan_modification(recipe, plan, progress);
    return plan;
  }
  int channels = 0;
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) {
    plan.boundaries.push_back(plan_boundary(grid, progress));
    const std::vector<int> components = components_of(grid.output);
    channels += std::accumulate(components.begin(), components.end(), 0);
  }
  if (auto* shape = std::get_if<GridShape>(&plan.shape)) {
    plan.grid = read_grid(*shape, "--shape", progress);
    plan.frame = GridFrame(plan.grid->transform());
    plan.voxels = plan.grid->evalActiveVoxelBoundingBox();
    plan.box = plan.frame.bounds(plan.voxels);
    const std::uint64_t held = plan.grid->memUsage() + (part.whole() ? 0 : estimate_mask_memory(*plan.grid));
    plan.memory =
        held + estimate_part_memory(estimate_memory(*plan.grid, channels), plan.frame, part, channels);
    plan.mask_memory = held + estimate_mask_memory(*plan.grid);
    return plan;
  }
  if (auto* shape = std::get_if<MeshShape>(&plan.shape)) {
    plan.mesh = read_closed_mesh(shape->file);
    plan.box = plan.mesh->bounds();
    note_digest(shape->file, "--shape", shape->digest);
  }
  plan.frame = GridFrame(recipe.voxel ? *recipe.voxel : voxel_size_for_dim(plan.box, recipe.dim));
  plan.voxels = plan.frame.voxels_in(plan.box);
  const double size = plan.frame.voxel_size().x;
  plan.voxels.expand(static_cast<int>(std::ceil(0.5 * edge_of(recipe, plan.frame.voxel_size()) / size)));
  plan.memory = estimate_part_memory(estimate_memory(plan.voxels, channels), plan.frame, part, channels);
  plan.mask_memory = estimate_mask_memory(plan.voxels);
  return plan;
}

}  // namespace

VolumePlan plan_volume(const VolumeRecipe& recipe, const VolumePart& part, Progress* progress) {
  recipe.validate();
  part.validate();
  require_utf8(to_json(recipe));  // what is made carries it
  VolumePlan plan = plan_voxels(recipe, part, progress);
  const auto add_memory = [&](std::uint64_t bytes) {
    plan.memory += bytes;
    plan.mask_memory += bytes;
  };
  for (const VolumePlan::GridBoundary& boundary : plan.boundaries) {
    if (boundary.distance) add_memory(boundary.distance->memory());
  }
  if (!recipe.parameters.any()) return plan;
  plan.parameters = std::make_shared<ParameterFields>(recipe.parameters, progress);
  plan.parameters->require_overlap(plan.modification ? world_bounds(plan.modification->grid()) : plan.box);
  add_memory(plan.parameters->memory());
  return plan;
}

VolumeRecipe with_digests(const VolumeRecipe& recipe, const VolumePlan& plan) {
  VolumeRecipe noted = recipe;
  noted.shape = plan.shape;
  if (plan.modification) noted.modification = plan.modification->modification;
  for (std::size_t i = 0; i < plan.boundaries.size(); ++i) {
    grid_of(noted, i).boundary = plan.boundaries[i].boundary;
  }
  if (plan.parameters) noted.parameters = plan.parameters->grids();
  return noted;
}

namespace {

// The fields that modify the plan's grid, of whichever recipe that asks for.
MakeModifyingField modifying_field(const VolumePlan& plan) {
  return [&plan](const VolumeRecipe& of) { return make_volume_field(of, plan).field; };
}

// Layers of whole leaves that a topology can be cut into along an axis, from below.
std::vector<VolumePart> slabs_of(const Topology& topology, int axis) {
  constexpr int kThickness = 64;  // voxels: two of the blocks that impulses are made for once
  constexpr int kHalfLeaf = 4;
  const openvdb::CoordBBox voxels = topology.voxel_bounds();
  const Box<3> bounds = topology.frame.bounds(voxels.expandBy(kThickness));
  std::vector<VolumePart> slabs;
  for (int first = voxels.min()[axis] & ~(kThickness - 1); first <= voxels.max()[axis]; first += kThickness) {
    // Leaves count by their first voxel: the border lies well between those of two.
    const double voxel = topology.frame.voxel_size()[axis];
    Box<3> region = bounds;
    region.lower[axis] = topology.frame.origin()[axis] + (first - kHalfLeaf) * voxel;
    region.upper[axis] = region.lower[axis] + kThickness * voxel;
    slabs.push_back({.region = region});
  }
  return slabs;
}

}  // namespace

namespace {

// Where the field is empty, unless a grid keeps those voxels.
IsFree free_voxels(const VolumeField& field, const GridFrame& frame) {
  const bool keeps = std::ranges::any_of(
      field.grids, [](const GridChannels& grid) { return grid.sparsity == Sparsity::keep; });
  if (keeps) return {};
  return
      [&field, frame](const openvdb::CoordBBox& voxels) { return field.field->empty(frame.bounds(voxels)); };
}

}  // namespace

Volume make_volume(const VolumeRecipe& recipe, const VolumePlan& plan, const std::string& creator,
                   Progress* progress) {
  const VolumeRecipe noted = with_digests(recipe, plan);
  if (plan.modification) {
    if (plan.parameters && plan.modification->on_lattice()) {
      plan.parameters->require_allowed_at(grid_topology(plan.modification->grid()));
    }
    return make_modified_volume(noted, *plan.modification, modifying_field(plan), progress);
  }
  const auto [topology, cover] = make_shape(recipe, plan, progress);
  const VolumeField field = make_volume_field(recipe, plan, cover);
  const Topology part = take_part(topology, plan.part, free_voxels(field, topology.frame));
  if (plan.parameters) plan.parameters->require_allowed_at(part);
  Volume volume{fill_grids(part, *field.field, field.grids, progress)};
  if (plan.part.whole()) {
    finish_volume(noted, creator, volume);
  } else {
    note_part(noted, creator, topology, part, volume);
    for (const MeasuredGrid& measured : volume.grids) {
      set_metadata(*measured.grid, {{kPartKey, text_of(plan.part)}});
    }
  }
  return volume;
}

bool holds_volume(const std::filesystem::path& path, const VolumeRecipe& recipe, const VolumePlan& plan,
                  Reading reading) {
  // It says "algorithm" too.
  const std::string wanted = format_json(to_json(with_digests(recipe, plan)));
  const std::string part = plan.part.whole() ? std::string() : text_of(plan.part);
  try {
    const std::vector<GridSummary> grids = read_vdb_summary(path).grids;
    const bool says_so = std::ranges::any_of(grids, [&](const GridSummary& grid) {
      const auto text = [&](const char* key) {
        const auto found = grid.metadata.find(key);
        return found == grid.metadata.end() ? std::string() : found->second;
      };
      return text(kRecipeKey) == wanted && text(kPartKey) == part;
    });
    if (!says_so || reading == Reading::headers) return says_so;
    if (!plan.part.whole()) return is_sound_part(path);
    const openvdb::GridPtrVec whole = read_grids(path).grids;
    return !whole.empty() && std::ranges::all_of(whole, [](const auto& grid) { return is_as_noted(*grid); });
  } catch (const std::runtime_error&) {
    return false;
  }
}

bool measures_density(const VolumeRecipe& recipe) {
  if (recipe.density.factor) return false;
  if (recipe.modification) return scales_density(recipe, *recipe.modification);
  return !std::holds_alternative<RawShaping>(recipe.shaping);
}

std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const VolumePlan& plan,
                                             Progress* progress) {
  if (plan.modification) {
    return measure_density_factor(recipe, *plan.modification, modifying_field(plan), progress);
  }
  const auto [topology, cover] = make_shape(recipe, plan, progress);
  const VolumeField field = make_volume_field(recipe, plan, cover);
  if (plan.parameters) plan.parameters->require_allowed_at(topology);
  const int axis = vertical_axis(recipe);
  ColumnSums columns(topology.voxel_bounds(), axis);
  double peak = 0.0;
  const std::vector<VolumePart> slabs = slabs_of(topology, axis);
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const auto share = [&](std::size_t k) {
      return static_cast<double>(k) / static_cast<double>(slabs.size());
    };
    PartialProgress of_slab(progress, share(i), share(i + 1));
    const FilledGrid slab = fill_grid(take_part(topology, slabs[i]), *field.field, Sparsity::drop, &of_slab);
    if (slab.moments.count() == 0) continue;
    columns.add(*slab.grid);
    peak = std::max(peak, slab.moments.max());
  }
  return density_factor(recipe.density, peak, columns.largest() * plan.frame.voxel_size()[axis]);
}

}  // namespace solidnoise
