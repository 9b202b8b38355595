#include "solidnoise/volume/volume_cost.h"

#include <algorithm>
#include <variant>
#include <vector>

#include <tbb/global_control.h>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

// Measured with each preset: storing a voxel, shaping its noise, and piling a cloud.
constexpr double kSecondsPerVoxel = 15e-9;
constexpr double kSecondsPerShapedVoxel = 30e-9;
constexpr double kSecondsPerCloudVoxel = 150e-9;

// Voxels from which on blocks are of 64^3, else of 32^3 (fill_grids()).
constexpr double kManyVoxels = 64.0 * 512.0 * 512.0;

bool has_warp(const std::vector<Layer>& layers) {
  return std::ranges::any_of(
      layers, [](const Layer& layer) { return layer.warp.has_value() || has_warp(layer.layers); });
}

bool at_points(const VolumeRecipe& recipe, const VolumePlan& plan) {
  return recipe.parameters.vary_kernel() || has_warp(recipe.layers) ||
         (plan.modification && !plan.modification->on_lattice());
}

double seconds_per_voxel(const VolumeRecipe& recipe) {
  if (std::holds_alternative<RawShaping>(recipe.shaping)) return kSecondsPerVoxel;
  return kSecondsPerVoxel + (std::holds_alternative<CloudShaping>(recipe.shaping) ? kSecondsPerCloudVoxel
                                                                                  : kSecondsPerShapedVoxel);
}

bool contains(const VolumeRecipe& recipe, Output output) {
  return std::ranges::find(recipe.output, output) != recipe.output.end();
}

// How many noises like its own a short form's outputs are made of.
int channels_of(const VolumeRecipe& recipe) {
  if (contains(recipe, Output::curl) || contains(recipe, Output::color)) return 3;
  return contains(recipe, Output::phase) || contains(recipe, Output::intensity) ? 2 : 1;
}

double count(const openvdb::CoordBBox& voxels) {
  return voxels.empty() ? 0.0 : static_cast<double>(voxels.dim().x()) * voxels.dim().y() * voxels.dim().z();
}

// Of the plan's part.
double voxels_of(const VolumePlan& plan) {
  double voxels = plan.modification ? static_cast<double>(plan.modification->grid().activeVoxelCount())
                  : plan.grid       ? static_cast<double>(plan.grid->activeVoxelCount())
                                    : count(plan.voxels);
  if (plan.part.region) {
    openvdb::CoordBBox region = plan.frame.voxels_in(*plan.part.region);
    region.intersect(plan.voxels);
    voxels *= count(region) / count(plan.voxels);
  }
  return voxels / plan.part.shards;
}

Cost noise_cost(const VolumeRecipe& recipe, const NoiseRecipe& of, const VolumePlan& plan) {
  VolumeRecipe single = recipe;
  single.noise = of;
  const auto noise = make_volume_noise(single);
  const double voxels = voxels_of(plan);
  if (at_points(recipe, plan)) return cost_at_points(*noise, voxels);
  const bool slopes = contains(recipe, Output::gradient) || contains(recipe, Output::curl);
  const double error = recipe.exact ? 0.0 : ErrorBudget(error_of(of)).interpolation;
  return cost_on_lattice(*noise, voxel_lattice(single, plan.frame),
                         {.samples = voxels,
                          .side = voxels < kManyVoxels ? 32.0 : 64.0,
                          .error = error,
                          .quantity = slopes ? Quantity::gradient : Quantity::values});
}

}  // namespace

int max_threads() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

Cost volume_cost(const VolumeRecipe& recipe, const VolumePlan& plan, int threads) {
  Cost cost;
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) {
    const VolumeRecipe resolved = at_resolution(grid, plan.frame.voxel_size());
    cost.seconds += voxels_of(plan) * channels_of(grid) * seconds_per_voxel(grid);
    for (const NoiseRecipe& noise : noises_of(resolved)) {
      const Cost of_noise = noise_cost(resolved, noise, plan);
      for (int channel = 0; channel < channels_of(grid); ++channel) cost += of_noise;
    }
  }
  cost.bytes = cost.bytes * threads + static_cast<double>(plan.memory);
  return cost;
}

}  // namespace solidnoise
