#include "solidnoise/volume/finish_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

// What a grid's metadata say of its values.
struct Statistic {
  const char* key;
  double (Moments::*of)() const;
};
constexpr Statistic kStatistics[] = {{"solidnoise:min", &Moments::min},
                                     {"solidnoise:max", &Moments::max},
                                     {"solidnoise:mean", &Moments::mean},
                                     {"solidnoise:sigma", &Moments::sigma}};

// A statistic of each component: a number for a grid of floats, a vector for one of vectors.
MetadataValue of_components(const std::vector<Moments>& moments, const Statistic& statistic) {
  const auto of = [&](std::size_t i) { return (moments[i].*statistic.of)(); };
  if (moments.size() == 1) return of(0);
  return Vec<3>(of(0), of(1), of(2));
}

Metadata describe(const VolumeRecipe& recipe, const std::vector<Moments>& moments) {
  Metadata metadata{
      {kRecipeKey, format_json(to_json(recipe))},
      {"solidnoise:algorithm", std::int64_t{kAlgorithmVersion}},
      {"solidnoise:seed", std::to_string(seed_of(recipe.noise))},
      {"solidnoise:up_axis", std::string(name_of(kUpAxisChoices, recipe.up))},
  };
  for (const Statistic& statistic : kStatistics) metadata[statistic.key] = of_components(moments, statistic);
  return metadata;
}

}  // namespace

bool OutputGrid::is_density() const {
  return !std::holds_alternative<RawShaping>(single.shaping);
}

std::vector<OutputGrid> output_grids(const VolumeRecipe& recipe) {
  const std::vector<std::string> names = grid_names(recipe);
  std::vector<OutputGrid> grids;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    for (const Output output : single.output) grids.push_back({single, output, names[grids.size()]});
  }
  return grids;
}

void name_grid(const OutputGrid& of, const std::string& creator, openvdb::GridBase& grid) {
  if (of.is_density()) {
    set_fog_volume(dynamic_cast<openvdb::FloatGrid&>(grid), of.name, creator);
  } else {
    grid.setName(of.name);
    grid.setCreator(creator);
    set_vector_type(grid, of.output);
  }
  grid.setSaveFloatAsHalf(of.single.half);
}

void drop_below(float least, openvdb::FloatGrid& grid) {
  using Leaf = openvdb::FloatTree::LeafNodeType;
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid.tree());
  leaves.foreach ([least](Leaf& leaf, std::size_t) {
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      if (*voxel < least) leaf.setValueOff(voxel.pos(), 0.0f);
    }
  });
  openvdb::tools::pruneInactive(grid.tree());
}

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

bool is_as_noted(const openvdb::GridBase& grid) {
  std::vector<Moments> moments;
  if (const auto* const floats = dynamic_cast<const openvdb::FloatGrid*>(&grid)) {
    moments = {measure(*floats)};
  } else if (const auto* const vectors = dynamic_cast<const openvdb::Vec3SGrid*>(&grid)) {
    const auto of_each = measure(*vectors);
    moments.assign(of_each.begin(), of_each.end());
  } else {
    return true;
  }
  const auto count = grid.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
  if (count && static_cast<std::uint64_t>(count->value()) != moments[0].count()) return false;
  const double rounding = grid.saveFloatAsHalf() ? 1e-3 : 1e-12;
  const auto is_noted = [&](const Statistic& statistic) {
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const double found = (moments[i].*statistic.of)();
      double noted = found;
      if (const auto number = grid.getMetadata<openvdb::DoubleMetadata>(statistic.key))
        noted = number->value();
      if (const auto vector = grid.getMetadata<openvdb::Vec3DMetadata>(statistic.key)) {
        noted = vector->value()[static_cast<int>(i)];
      }
      const double most = std::max(std::abs(moments[i].min()), std::abs(moments[i].max()));
      if (!(std::abs(found - noted) <= rounding * most)) return false;
    }
    return true;
  };
  return std::ranges::all_of(kStatistics, is_noted);
}

void finish_volume(const VolumeRecipe& recipe, const std::string& creator, Volume& volume) {
  const std::vector<OutputGrid> outputs = output_grids(recipe);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    MeasuredGrid& measured = volume.grids[i];
    const VolumeRecipe& single = outputs[i].single;
    if (outputs[i].is_density()) {
      auto& density = dynamic_cast<openvdb::FloatGrid&>(*measured.grid);
      Moments& moments = measured.moments.front();
      note_density_factor(scale_density(single, density, moments), density);
      if (single.prune > 0.0 && moments.count() > 0) {
        drop_below(static_cast<float>(single.prune * moments.max()), density);
        moments = measure(density);
      }
    }
    name_grid(outputs[i], creator, *measured.grid);
    note_recipe(recipe, measured.moments, *measured.grid);
  }
}

}  // namespace solidnoise
