#include "digests/make_recipes.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "digests/digest_grid.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/recipe_field.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "support/scattered.h"

namespace solidnoise {
namespace {

constexpr char kCreator[] = "digests";

NoiseRecipe recipe_of(const Json& noise) {
  JsonReader reader(noise);
  return noise_recipe_from_json(reader);
}

void add(const Volume& volume, Digest& digest) {
  for (const openvdb::GridBase::ConstPtr& grid : grids_of(volume)) add_grid(*grid, digest);
}

}  // namespace

template <int Dim>
std::shared_ptr<const Noise<Dim>> noise_of(const Json& noise, double time) {
  return make_noise<Dim>(at_time(recipe_of(noise), time));
}
template <int Dim>
std::shared_ptr<const Noise<Dim>> quadrature_of(const Json& noise) {
  return make_quadrature<Dim>(recipe_of(noise));
}

void add_volume(const Json& json, Digest& digest) {
  const VolumeRecipe recipe = volume_recipe_from_json(json);
  add(make_volume(recipe, plan_volume(recipe), kCreator), digest);
}

void add_merged_volume(const Json& json, const std::filesystem::path& folder, Digest& digest) {
  constexpr int kShards = 3;
  const VolumeRecipe recipe = volume_recipe_from_json(json);
  std::vector<std::filesystem::path> files;
  for (int shard = kShards; shard >= 1; --shard) {
    const Volume part =
        make_volume(recipe, plan_volume(recipe, {.shard = shard, .shards = kShards}), kCreator);
    files.push_back(folder / ("part" + std::to_string(shard) + ".vdb"));
    write_vdb(files.back(), grids_of(part), {.existing = Existing::replace});
  }
  add(merge_parts(files, kCreator).volume, digest);
}

void add_density_factor(const Json& json, Digest& digest) {
  const VolumeRecipe recipe = volume_recipe_from_json(json);
  digest.add_one(measure_density_factor(recipe, plan_volume(recipe)).value());
}

void add_volume_points(const Json& json, Digest& digest) {
  const Scattered<3> scattered = scattered_points<3>(400, 2.0);
  std::vector<Vec<3>> positions;
  for (std::size_t i = 0; i < scattered.size(); ++i) {
    positions.emplace_back(scattered.offset[0][i], scattered.offset[1][i], scattered.offset[2][i]);
  }
  std::vector<float> values(positions.size());
  const RecipeField field(volume_recipe_from_json(json));
  field.on_voxels(field.frame()).field->evaluate({positions}, {values, {}});
  digest.add(std::span<const float>(values));
}

template std::shared_ptr<const Noise<1>> noise_of(const Json&, double);
template std::shared_ptr<const Noise<2>> noise_of(const Json&, double);
template std::shared_ptr<const Noise<3>> noise_of(const Json&, double);
template std::shared_ptr<const Noise<4>> noise_of(const Json&, double);
template std::shared_ptr<const Noise<2>> quadrature_of(const Json&);
template std::shared_ptr<const Noise<3>> quadrature_of(const Json&);
template std::shared_ptr<const Noise<4>> quadrature_of(const Json&);

}  // namespace solidnoise
