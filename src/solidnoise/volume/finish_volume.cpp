#include "solidnoise/volume/finish_volume.h"

#include <cstddef>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

// A statistic of each component: a number for a grid of floats, a vector for one of vectors.
template <typename Statistic>
MetadataValue of_components(const std::vector<Moments>& moments, const Statistic& statistic) {
  if (moments.size() == 1) return statistic(moments[0]);
  return Vec<3>(statistic(moments[0]), statistic(moments[1]), statistic(moments[2]));
}

Metadata describe(const VolumeRecipe& recipe, const std::vector<Moments>& moments) {
  return {
      {kRecipeKey, format_json(to_json(recipe))},
      {"solidnoise:algorithm", std::int64_t{kAlgorithmVersion}},
      {"solidnoise:seed", std::to_string(seed_of(recipe.noise))},
      {"solidnoise:up_axis", std::string(name_of(kUpAxisChoices, recipe.up))},
      {"solidnoise:min", of_components(moments, [](const Moments& m) { return m.min(); })},
      {"solidnoise:max", of_components(moments, [](const Moments& m) { return m.max(); })},
      {"solidnoise:mean", of_components(moments, [](const Moments& m) { return m.mean(); })},
      {"solidnoise:sigma", of_components(moments, [](const Moments& m) { return m.sigma(); })},
  };
}

// Densities below a part of the largest one.
void drop_dust(double part, openvdb::FloatGrid& grid, Moments& moments) {
  if (part == 0.0 || moments.count() == 0) return;
  using Leaf = openvdb::FloatTree::LeafNodeType;
  const auto least = static_cast<float>(part * moments.max());
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid.tree());
  leaves.foreach ([least](Leaf& leaf, std::size_t) {
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      if (*voxel < least) leaf.setValueOff(voxel.pos(), 0.0f);
    }
  });
  openvdb::tools::pruneInactive(grid.tree());
  moments = measure(grid);
}

}  // namespace

std::optional<double> density_factor(const DensityScale& density, double peak, double thickest) {
  const double largest = density.peak ? peak : thickest;
  if (largest <= 0.0) return std::nullopt;
  return density.peak.value_or(density.optical_depth) / largest;
}

double scale_density(const VolumeRecipe& recipe, openvdb::FloatGrid& grid, Moments& moments) {
  const DensityScale& density = recipe.density;
  std::optional<double> factor = density.factor;
  if (!factor) {
    const double thickest = density.peak ? 0.0 : thickest_column(grid, vertical_axis(recipe));
    factor = density_factor(density, moments.max(), thickest);
  }
  if (!factor) return 1.0;  // a grid of zeros stays as it is
  scale_values(grid, static_cast<float>(*factor));
  moments = measure(grid);
  return *factor;
}

void note_density_factor(double factor, openvdb::GridBase& grid) {
  set_metadata(grid, {{"solidnoise:density_factor", factor}});
}

void note_recipe(const VolumeRecipe& recipe, const std::vector<Moments>& moments, openvdb::GridBase& grid) {
  set_metadata(grid, describe(recipe, moments));
}

void finish_volume(const VolumeRecipe& recipe, const std::string& creator, Volume& volume) {
  const std::vector<std::string> names = grid_names(recipe);
  std::size_t i = 0;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    const bool raw = std::holds_alternative<RawShaping>(single.shaping);
    for (const Output output : single.output) {
      MeasuredGrid& measured = volume.grids[i];
      openvdb::GridBase& grid = *measured.grid;
      if (!raw) {
        auto& density = dynamic_cast<openvdb::FloatGrid&>(grid);
        note_density_factor(scale_density(single, density, measured.moments.front()), grid);
        drop_dust(single.prune, density, measured.moments.front());
        set_fog_volume(density, names[i], creator);
      } else {
        grid.setName(names[i]);
        grid.setCreator(creator);
        set_vector_type(grid, output);
      }
      grid.setSaveFloatAsHalf(single.half);
      note_recipe(recipe, measured.moments, grid);
      ++i;
    }
  }
}

}  // namespace solidnoise
