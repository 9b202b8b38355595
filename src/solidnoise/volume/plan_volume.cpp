#include "solidnoise/volume/plan_volume.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/geometry/read_mesh.h"
#include "solidnoise/volume/modify/modified_volume.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/topology/world_bounds.h"

namespace solidnoise {
namespace {

// Takes place and voxels of the grid that is modified.
void plan_modification(const VolumeRecipe& recipe, VolumePlan& plan) {
  if (!plan.part.whole()) {
    throw std::invalid_argument("a grid that exists is worked on as a whole; leave out region and shard");
  }
  ModificationPlan modification = plan_modification(recipe);
  const openvdb::FloatGrid& grid = modification.grid();
  plan.voxels = grid.evalActiveVoxelBoundingBox();
  const openvdb::Vec3d size = grid.transform().voxelSize(plan.voxels.getCenter());
  plan.frame = modification.frame().value_or(GridFrame(std::max({size.x(), size.y(), size.z()})));
  plan.box = plan.frame.bounds(plan.voxels);
  plan.memory = estimate_memory(recipe, modification);
  plan.modification = std::move(modification);
}

// Reads the surface that a velocity is to stay off, if there is one.
VolumePlan::GridBoundary plan_boundary(const VolumeRecipe& recipe) {
  VolumePlan::GridBoundary plan{recipe.boundary, nullptr};
  if (!plan.boundary) return plan;
  const openvdb::FloatGrid::Ptr surface = read_float_grid(plan.boundary->surface, "--boundary");
  try {
    require_level_set(*surface);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", plan.boundary->surface.file, error.what()));
  }
  const double frequency = std::visit([](const auto& noise) { return noise.frequency; }, recipe.noise.noise);
  plan.distance = std::make_shared<DistanceSpline>(surface, plan.boundary->width.value_or(1.0 / frequency));
  return plan;
}

// All of the plan but the parameters.
VolumePlan plan_voxels(const VolumeRecipe& recipe, const VolumePart& part) {
  VolumePlan plan;
  plan.part = part;
  plan.box = recipe.box;
  plan.shape = recipe.shape;
  if (recipe.modification) {
    plan_modification(recipe, plan);
    return plan;
  }
  int channels = 0;
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) {
    plan.boundaries.push_back(plan_boundary(grid));
    const std::vector<int> components = components_of(grid.output);
    channels += std::accumulate(components.begin(), components.end(), 0);
  }
  if (auto* shape = std::get_if<GridShape>(&plan.shape)) {
    plan.grid = read_grid(*shape, "--shape");
    plan.frame = GridFrame(plan.grid->transform());
    plan.voxels = plan.grid->evalActiveVoxelBoundingBox();
    plan.box = plan.frame.bounds(plan.voxels);
    plan.memory = estimate_part_memory(estimate_memory(*plan.grid, channels), plan.frame, part);
    return plan;
  }
  if (auto* shape = std::get_if<MeshShape>(&plan.shape)) {
    PolygonMesh mesh = read_mesh(shape->file).mesh;
    plan.mesh = TriangleMesh{std::move(mesh.positions), triangulate(mesh)};
    try {
      require_closed(*plan.mesh);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", shape->file, error.what()));
    }
    plan.box = plan.mesh->bounds();
    note_digest(shape->file, "--shape", shape->digest);
  }
  plan.frame = GridFrame(recipe.voxel ? *recipe.voxel : voxel_size_for_dim(plan.box, recipe.dim));
  plan.voxels = plan.frame.voxels_in(plan.box);
  plan.memory = estimate_part_memory(estimate_memory(plan.voxels, channels), plan.frame, part);
  return plan;
}

}  // namespace

VolumePlan plan_volume(const VolumeRecipe& recipe, const VolumePart& part) {
  recipe.validate();
  part.validate();
  VolumePlan plan = plan_voxels(recipe, part);
  if (!recipe.parameters.any()) return plan;
  plan.parameters = std::make_shared<ParameterFields>(recipe.parameters);
  plan.parameters->require_overlap(plan.modification ? world_bounds(plan.modification->grid()) : plan.box);
  plan.memory += plan.parameters->memory();
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

}  // namespace solidnoise
