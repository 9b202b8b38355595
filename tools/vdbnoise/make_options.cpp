#include "vdbnoise/make_options.h"

#include <algorithm>
#include <cstddef>

#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/noise_flags.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/grid_flags.h"
#include "vdbnoise/volume_flags.h"

namespace solidnoise {
namespace {

// Calls change(grid) for the recipe's grids, or for the recipe itself.
template <typename Change>
void change_grids(VolumeRecipe& recipe, const Change& change) {
  for (std::size_t i = 0; i < std::max<std::size_t>(1, recipe.grids.size()); ++i) change(grid_of(recipe, i));
}

void declare_output(FlagSet& flags, MakeOptions& options) {
  flags.group("Output");
  flags.keep("--out", "FILE.vdb",
             "Where the grid goes; - for the standard output; FILE.nvdb: as NanoVDB, which has no place for "
             "the recipe",
             options.out);
  flags.toggle("--usd", "Write a scene in USD too, which shows the volume: a .usda beside --out",
               [&] { options.usd = true; });
  flags.keep("--preview", "FILE.png",
             "A picture of the volume; of vectors, colours and phases one of a slice", options.preview);
  declare_fields(flags, options.recipe, {"look"});
  flags.add({"--preview-frame", FlagForm<GridFile>::names({}),
             "Frame the picture by this grid's active voxels: parts and frames, from one place",
             [&](const std::vector<std::string>& texts) {
               options.frame_source = FlagForm<GridFile>::read("--preview-frame", texts);
             }});
  declare_fields<RunOptions>(flags, options, {"force"});
  flags.toggle("--skip-existing", "Keep volumes that exist, are whole, and are of the same recipe",
               [&] { options.skip_existing = true; });
  flags.exclude({"--force", "--skip-existing"});
  VolumeRecipe& recipe = options.recipe;
  declare_output_flags(flags, recipe);
  GridRecipe& grid = recipe;
  declare_field(flags, grid, "name", {"--grid"}, [&grid](const std::string& name) { grid.grid = name; });
  declare_field(flags, grid, "half", [&recipe](bool half) {
    change_grids(recipe, [half](GridRecipe& each) { each.half = half; });
  });
  declare_fields(flags, recipe, {"codec"});
  flags.choice("--nvdb-bits", {"32", "16", "8", "4"},
               "Of a .nvdb's values, 32 being floats; fewer are steps between the least and the greatest of "
               "each 8 x 8 x 8 voxels. Vectors stay floats (default 32)",
               [&](std::size_t index) { options.nvdb_values = NvdbValues(index); });
}

void declare_density(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Density");
  declare_shaping_flags(flags, recipe);
  DensityScale& density = recipe.density;
  declare_field(flags, density, "optical_depth", [&](double depth) { density = {depth}; });
  declare_field(flags, density, "peak", {"--density"}, [&](const std::optional<double>& peak) {
    density = {DensityScale().optical_depth, peak};
  });
  declare_field(flags, density, "factor", {"--density-factor"},
                [&](const std::optional<double>& factor) { density.factor = factor; });
  flags.exclude({"--optical-depth", "--density", "--density-factor"});
  for (const char* scale : {"--optical-depth", "--density", "--density-factor"}) {
    flags.exclude({"--raw", scale});
  }
  declare_field(flags, static_cast<GridRecipe&>(recipe), "prune", [&](double part) {
    change_grids(recipe, [part](GridRecipe& grid) {
      if (!std::holds_alternative<RawShaping>(grid.shaping)) grid.prune = part;
    });
  });
  declare_layer_flags(flags, recipe);
}

void declare_shape(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Shape and resolution (1 world unit is 1 m)");
  Domain& domain = recipe;
  declare_fields(flags, domain, {"shape"});
  declare_field(flags, recipe, "up", [&](UpAxis up) { turn_up(recipe, up); });
  declare_fields(flags, domain, {"box", "edge", "edge_voxels", "voxel"});
  declare_field(flags, domain, "dim", [&](int dim) {
    recipe.dim = dim;
    recipe.voxel.reset();
  });
  flags.exclude({"--voxel", "--dim"});
  flags.exclude({"--edge", "--edge-voxels"});
}

}  // namespace

std::vector<std::string> declare_make_flags(FlagSet& flags, MakeOptions& options) {
  VolumeRecipe& recipe = options.recipe;
  flags.show_first({"--out", "--preset", "--preview", "--seed", "--frequency", "--octaves", "--dim",
                    "--optical-depth", "--shape", "--frames"});
  flags.may_vary(true);
  declare_output(flags, options);
  declare_recipe_flags(flags, "a .vdb made by vdbnoise", options.write_recipe, volume_recipe_schema);
  flags.group("Noise");
  const std::vector<std::string> noise_flags = declare_noise_flags(flags, recipe.noise);
  declare_fields(flags, recipe, {"offset", "band_limit", "exact"});
  declare_parameter_flags(flags, recipe);
  flags.group("Time");
  flags.may_vary(false);  // rates of what moves are of all frames
  declare_fields(flags, recipe, {"dims"});
  declare_time_flags(flags, recipe);
  flags.may_vary(true);
  flags.group("Noise");
  declare_generator_flag(flags, recipe.noise, recipe.dims);
  declare_density(flags, recipe);
  declare_shape(flags, recipe);
  declare_modify_flags(flags, recipe);
  flags.may_vary(false);
  declare_sequence_flags(flags, options);
  flags.group("Run");
  flags.add({"--describe", "", "Print what would be made, as JSON, and write nothing"});
  declare_fields<RunOptions>(flags, options, {"threads", "max_memory", "max_time", "quiet", "timings"});
  flags.footer(
      "Defaults are those of the recipe to start from: vdbnoise --preset smoke --help seed. With --frames "
      "most\nnumbers may be curves, frame:value, linear between and held outside: --density 0:1,24:3");
  return noise_flags;
}

void check_make_options(const FlagSet& flags, const MakeOptions& options,
                        const std::vector<std::string>& noise_flags) {
  const VolumeRecipe& recipe = options.recipe;
  if (std::holds_alternative<GridShape>(recipe.shape)) {
    flags.refuse({"--edge", "--edge-voxels", "--voxel", "--dim"},
                 "has no effect where --shape is a grid, whose voxels are kept");
  }
  if (std::holds_alternative<MeshShape>(recipe.shape) || std::holds_alternative<GridShape>(recipe.shape)) {
    flags.refuse({"--box"}, "has no effect where --shape is a file; leave one of them out");
  }
  if (!recipe.grids.empty()) {
    flags.refuse({"--output", "--speed", "--boundary", "--boundary-width", "--grid", "--raw", "--range",
                  "--threshold", "--softness", "--power", "--floor", "--fold", "--histogram", "--warp",
                  "--optical-depth", "--density", "--density-factor", "--on"},
                 "has no effect where the recipe makes several grids, each with its own");
  }
  check_modify_flags(flags, recipe);
  check_layer_flags(flags, recipe, noise_flags);
  check_parameter_flags(flags, recipe);
  if (recipe.grids.empty() && std::holds_alternative<RawShaping>(recipe.shaping)) {
    flags.refuse({"--optical-depth", "--density", "--density-factor", "--edge", "--edge-voxels", "--prune"},
                 "has no effect on raw noise");
  }
  if (options.out == "-" && options.write_recipe == "-") {
    throw UsageError("--out and --write-recipe cannot both be the standard output");
  }
}

}  // namespace solidnoise
