#include "solidnoise/volume/modified_volume.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {
namespace {

bool is_raw(const VolumeRecipe& recipe) {
  return std::holds_alternative<RawShaping>(recipe.shaping);
}

// The root mean square of what displaces.
double size_of(const VolumeRecipe& recipe) {
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  const auto range = raw != nullptr ? raw->range : RawShaping::Range::unit;
  constexpr double kThird = 1.0 / 3.0;
  if (range == RawShaping::Range::signed_values) return kThird;
  if (range == RawShaping::Range::unit) return std::hypot(0.5, 0.5 * kThird);
  double variance = 0.0;
  for (const double amplitude : recipe.noise.fractal.amplitudes()) variance += amplitude * amplitude;
  return std::sqrt(variance);
}

// That of a wave whose slope is the noise's, root mean square, cycles per world unit.
double frequency_of(const VolumeRecipe& recipe) {
  const FractalOptions& fractal = recipe.noise.fractal;
  double slopes = 0.0;
  double variance = 0.0;
  for (int k = 0; k < fractal.octaves; ++k) {
    const double power = std::pow(fractal.amplitude_ratio(k), 2);
    slopes += power * std::pow(fractal.frequency_ratio(k), 2);
    variance += power;
  }
  const double first = std::visit([](const auto& options) { return options.frequency; }, recipe.noise.noise);
  return first * std::sqrt(slopes / variance);
}

// Noise that is a fraction, which is what erodes.
VolumeRecipe in_unit_range(VolumeRecipe recipe) {
  if (is_raw(recipe)) recipe.shaping = RawShaping{RawShaping::Range::unit};
  return recipe;
}

openvdb::FloatGrid::Ptr make_grid(const VolumeRecipe& recipe, const ModificationPlan& plan,
                                  const MakeModifyingField& make_field, Progress* progress) {
  if (plan.modification.displace) return displace(plan, make_field(recipe), progress);
  const Combine how = plan.modification.combine;
  FilledGrid filled = make_modifying_noise(
      plan, *make_field(how == Combine::erode ? in_unit_range(recipe) : recipe), progress);
  if (!scales_density(recipe, plan.modification)) return combine(plan, *filled.grid);
  const double factor = scale_density(recipe, *filled.grid, filled.moments);
  const openvdb::FloatGrid::Ptr grid = combine(plan, *filled.grid);
  note_density_factor(factor, *grid);
  return grid;
}

}  // namespace

ModificationPlan plan_modification(const VolumeRecipe& recipe, Progress* progress) {
  if (recipe.modification->displace && !is_raw(recipe)) {
    throw std::invalid_argument(
        "displace takes the noise itself: give --raw, or a recipe whose shaping is raw");
  }
  ModificationPlan plan = plan_modification(*recipe.modification, progress);
  if (!plan.on_lattice() && !is_raw(recipe)) {
    throw std::invalid_argument(
        "noise is looked up point by point at rest positions, and where a grid's transform is rotated, "
        "sheared, "
        "mirrored or not linear; that takes the noise itself: give --raw, or a recipe whose shaping is raw");
  }
  return plan;
}

std::uint64_t estimate_memory(const VolumeRecipe& recipe, const ModificationPlan& plan) {
  return plan.memory(frequency_of(recipe), size_of(recipe));
}

double estimate_voxels(const VolumeRecipe& recipe, const ModificationPlan& plan) {
  return plan.voxels(frequency_of(recipe), size_of(recipe));
}

bool scales_density(const VolumeRecipe& recipe, const Modification& modification) {
  return !is_raw(recipe) && !modification.displace && modification.combine == Combine::replace;
}

std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const ModificationPlan& plan,
                                             const MakeModifyingField& make_field, Progress* progress) {
  const FilledGrid filled = make_modifying_noise(plan, *make_field(recipe), progress);
  return density_factor(recipe.density, filled.moments.max(),
                        thickest_column(*filled.grid, vertical_axis(recipe)));
}

Volume make_modified_volume(const VolumeRecipe& recipe, const ModificationPlan& plan,
                            const MakeModifyingField& make_field, Progress* progress) {
  const openvdb::FloatGrid::Ptr grid = make_grid(recipe, plan, make_field, progress);
  if (recipe.half) grid->setSaveFloatAsHalf(true);
  const Moments moments = measure(*grid);
  VolumeRecipe noted = recipe;
  noted.modification = plan.modification;
  note_recipe(noted, {moments}, *grid);
  VdbFile file{plan.file.metadata, replace_target(plan, grid)};
  return {{{grid, {moments}}}, std::move(file)};
}

}  // namespace solidnoise
