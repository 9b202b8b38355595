#include "solidnoise/volume/finish_volume.h"

#include <variant>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/fill.h"
#include "solidnoise/volume/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

Metadata describe(const VolumeRecipe& recipe, const Moments& moments) {
  return {
      {kRecipeKey, format_json(to_json(recipe))},
      {"solidnoise:algorithm", std::int64_t{kAlgorithmVersion}},
      {"solidnoise:seed", std::to_string(seed_of(recipe.noise))},
      {"solidnoise:up_axis", std::string(name_of(kUpAxisChoices, recipe.up))},
      {"solidnoise:min", moments.min()},
      {"solidnoise:max", moments.max()},
      {"solidnoise:mean", moments.mean()},
      {"solidnoise:sigma", moments.sigma()},
  };
}

}  // namespace

void scale_density(const VolumeRecipe& recipe, openvdb::FloatGrid& grid, Moments& moments) {
  const double largest =
      recipe.density.peak ? moments.max() : thickest_column(grid, recipe.up == UpAxis::y ? 1 : 2);
  if (largest <= 0.0) return;  // a grid of zeros stays as it is
  const double wanted = recipe.density.peak.value_or(recipe.density.optical_depth);
  scale_values(grid, static_cast<float>(wanted / largest));
  moments = measure(grid);
}

void note_recipe(const VolumeRecipe& recipe, const Moments& moments, openvdb::GridBase& grid) {
  set_metadata(grid, describe(recipe, moments));
}

void finish_volume(const VolumeRecipe& recipe, const std::string& creator, Volume& volume) {
  const bool raw = std::holds_alternative<RawShaping>(recipe.shaping);
  for (MeasuredGrid& measured : volume.grids) {
    openvdb::GridBase& grid = *measured.grid;
    if (!raw) {
      auto& density = dynamic_cast<openvdb::FloatGrid&>(grid);
      scale_density(recipe, density, measured.moments.front());
      set_fog_volume(density, recipe.grid, creator);
    } else {
      grid.setName(recipe.grid);
      grid.setCreator(creator);
    }
    grid.setSaveFloatAsHalf(recipe.half);
    note_recipe(recipe, measured.moments.front(), grid);
  }
}

}  // namespace solidnoise
