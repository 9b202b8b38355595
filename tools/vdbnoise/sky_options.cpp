#include "vdbnoise/sky_options.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/recipe/recipe_file.h"
#include "solidnoise/volume/sky/sky_tables.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/volume_flags.h"

namespace solidnoise {

std::span<const Preset> skies();  // skies/*.json

namespace {

// What `VALUE` of --cloud names: a preset of volumes, or a file.
VolumeRecipe read_cloud(const std::string& value) {
  const std::filesystem::path path = value;
  if (extension_of(path) == ".json" || extension_of(path) == ".vdb") {
    VolumeRecipe cloud;
    read_recipe(path, recipe_text_of(path), [&](const Json& json) { cloud = volume_recipe_from_json(json); });
    return cloud;
  }
  return volume_recipe_from_json(parse_json(presets()[parse_word("--cloud", value, preset_names())].json));
}

// Another up axis turns the sky about x.
void turn_sky(SkyRecipe& sky, UpAxis up) {
  if (sky.cloud.up == up) return;
  turn_up(sky.cloud, up);
  if (auto* const scattered = std::get_if<ScatteredPoints>(&sky.points)) {
    auto& area = scattered->area;
    area = {area[0], -area[3], area[2], -area[1]};
  }
}

void declare_points(FlagSet& flags, SkyRecipe& recipe) {
  flags.group("Points");
  flags.add({"--points", "FILE", "Places from a .csv or .ply: x, y, z, size, turn, seed",
             [&](const std::vector<std::string>& texts) { recipe.points = PointsFile{.file = texts[0]}; }});
  declare_alternatives(flags, recipe.points,
                       {{kSkyPointsTypes.begin(), kSkyPointsTypes.end()},
                        "{} does not apply to points that are {}; leave --points out"});
  declare_fields(flags, recipe, {"kinds"});
}

void declare_clouds(FlagSet& flags, SkyRecipe& recipe) {
  flags.group("Clouds");
  flags.text("--cloud", "RECIPE", "What is placed: a preset of volumes, a .json or a .vdb made by vdbnoise",
             [&](const std::string& value) {
               const UpAxis up = recipe.cloud.up;
               recipe.cloud = read_cloud(value);
               turn_up(recipe.cloud, up);
             });
  declare_field(flags, recipe.cloud, "up", [&](UpAxis up) { turn_sky(recipe, up); });
  declare_fields(flags, recipe, {"voxel", "lod_from", "lod_angle"});
  declare_field(flags, static_cast<GridRecipe&>(recipe.cloud), "half", [&](bool half) {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, recipe.cloud.grids.size()); ++i)
      grid_of(recipe.cloud, i).half = half;
  });
}

}  // namespace

void declare_sky_flags(FlagSet& flags, SkyOptions& options) {
  flags.group("Output");
  flags.keep(
      "--out", "FILE",
      "FILE.usda: a scene of instances, and a folder FILE with a .vdb of each cloud; FILE.vdb: one grid",
      options.out);
  flags.keep("--write-points", "FILE.csv",
             "Where clouds stand, as --points reads it; with a scene, their files and scales too",
             options.write_points);
  flags.add({"--region", "X0 Y0 Z0 X1 Y1 Z1",
             "Of one grid: only the voxels in a box, such as a tile [world units]",
             [&](const std::vector<std::string>& texts) {
               options.region = FlagForm<Box<3>>::read("--region", texts);
             },
             FlagForm<Box<3>>::kNumbers});
  declare_fields<RunOptions>(flags, options, {"force"});
  flags.toggle("--skip-existing", "Keep clouds that exist, are whole, and are of the same recipe",
               [&] { options.skip_existing = true; });
  flags.exclude({"--force", "--skip-existing"});
  declare_recipe_flags(flags, "a .vdb of a sky", options.write_recipe, sky_recipe_schema, skies());
  declare_points(flags, options.recipe);
  declare_clouds(flags, options.recipe);
  flags.group("Run");
  flags.add({"--describe", "", "Print what would be made, as JSON, and write nothing"});
  declare_fields<RunOptions>(flags, options, {"threads", "max_memory", "max_time", "quiet", "timings"});
}

SkyRecipe choose_sky_recipe(const FlagSet& flags) {
  SkyRecipe recipe;
  load_recipe(flags, {"cumulus_field", recipe_text_of, skies()},
              [&](const Json& json) { recipe = sky_recipe_from_json(json); });
  return recipe;
}

void check_sky_options(const FlagSet& flags, const SkyOptions& options) {
  require_extension("--out", options.out, {".usda", ".vdb"}, StandardOutput::refused);
  require_extension("--write-points", options.write_points, {".csv"}, StandardOutput::refused);
  if (!options.write_points.empty() && options.out.find_first_of(",#\"\n\r") != std::string::npos) {
    throw UsageError(fmt::format(
        "--out is {}; with --write-points, a table of these names, it must be without ',', '#' and quotes",
        printable(options.out)));
  }
  if (options.form() == SkyForm::grid) {
    flags.refuse({"--lod-from", "--lod-angle"}, "has no effect on one grid, whose voxels are all alike");
    flags.refuse({"--skip-existing"}, "keeps files of clouds; it needs --out FILE.usda");
  } else {
    flags.refuse({"--region"}, "is of one grid; it needs --out FILE.vdb");
  }
  if (!options.recipe.lod_from)
    flags.refuse({"--lod-angle"}, "has no effect without a camera; give --lod-from too");
}

}  // namespace solidnoise
