#include "vdbnoise/make_options.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "common/field_flags.h"
#include "common/flag_set.h"
#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/grid_flags.h"
#include "vdbnoise/recipe_flags.h"

namespace solidnoise {
namespace {

constexpr char kNoise[] = "Noise (defaults are those of --raw; presets have their own)";

// "box", "sphere", "ellipsoid", "bunny.obj", "smoke.vdb" or "smoke.vdb:density". Files are kept with their
// whole path, so that the recipe can be used from any folder.
Shape parse_shape(const std::string& text) {
  if (text == "box") return BoxShape{};
  if (text == "sphere") return SphereShape{};
  if (text == "ellipsoid") return EllipsoidShape{};
  if (is_mesh_path(text)) return MeshShape{std::filesystem::absolute(text).string()};
  if (parse_grid_file(text)) return parse_grid_flag("--shape", text);
  throw UsageError(
      fmt::format("--shape is {}; it must be box, sphere, ellipsoid, FILE.obj (or .ply, .off, .stl, .om), "
                  "FILE.vdb or FILE.vdb:GRID",
                  text));
}

// Another up axis turns the box about x, so that what stood upright still does.
void turn_up(VolumeRecipe& recipe, UpAxis up) {
  if (recipe.up == up) return;
  const Vec<3> lower = recipe.box.lower;
  const Vec<3> upper = recipe.box.upper;
  if (up == UpAxis::z) {
    recipe.box = {{lower.x, -upper.z, lower.y}, {upper.x, -lower.z, upper.y}};
  } else {
    recipe.box = {{lower.x, lower.z, -upper.y}, {upper.x, upper.z, -lower.y}};
  }
  recipe.up = up;
}

void declare_output(FlagSet& flags, MakeOptions& options) {
  flags.group("Output");
  keep(flags, "--out", "FILE.vdb", "Where the grid goes; - for the standard output", options.out);
  keep(flags, "--preview", "FILE.png",
       "A picture of the volume; of vectors, colours and phases one of a slice", options.preview);
  declare_choice(flags, "--look", kLookChoices,
                 "What the preview shows it as (default auto: by its grids; presets have their own)",
                 options.recipe.look);
  flags.text("--preview-frame", "FILE.vdb[:GRID]",
             "Frame the picture by this grid's active voxels: parts and frames, from one place",
             [](const std::string&) {});
  flags.toggle("--force", "Replace files that exist", [&] { options.existing = Existing::replace; });
  flags.toggle("--skip-existing", "Keep volumes that exist, are whole, and are of the same recipe",
               [&] { options.skip_existing = true; });
  flags.exclude({"--force", "--skip-existing"});
  declare_output_flags(flags, options.recipe);
  keep(flags, "--grid", "NAME", "Name of the grid (default density; of others than values, see the docs)",
       options.recipe.grid);
  flags.toggle("--half", "Store 16-bit floats: half the size, 3 digits", [&] {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, options.recipe.grids.size()); ++i) {
      grid_of(options.recipe, i).half = true;
    }
  });
  declare_choice(flags, "--codec", kCodecChoices,
                 "Compression of the file; zip gains nothing on fog volumes (default blosc)",
                 options.recipe.codec);
}

void declare_recipes(FlagSet& flags, MakeOptions& options) {
  flags.group("Recipes");
  flags.text("--preset", "NAME", "Start from a recipe that comes with the program (default cumulus)",
             [](const std::string&) {});
  flags.text("--recipe", "FILE", "Start from a recipe, .json, or from that of a .vdb made by vdbnoise",
             [](const std::string&) {});
  keep(flags, "--write-recipe", "FILE.json",
       "Write the recipe with all flags in it; - for the standard output", options.write_recipe);
  flags.exclude({"--preset", "--recipe"});
}

void declare_noise(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group(kNoise);
  declare_noise_flags(flags, recipe.noise);
  flags.numbers("--offset", "X Y Z", 3, "Moves the noise, world units (default 0 0 0)",
                [&](const std::vector<double>& v) {
                  recipe.offset = {v[0], v[1], v[2]};
                });
  flags.toggle(
      "--band-limit",
      "Gabor noises: filter out what the voxels cannot hold, exactly, so that looks do not depend on "
      "the resolution",
      [&] { recipe.band_limit = true; });
  flags.toggle(
      "--exact",
      "Sum impulses at every voxel; without it, waves that voxels resolve well are interpolated from "
      "fewer samples, within --error",
      [&] { recipe.exact = true; });
}

void declare_shaping(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Density");
  flags.toggle("--raw", "The noise itself: mean 0, variance 1; no shaping",
               [&] { recipe.shaping = RawShaping{}; });
  flags.choice("--range", names_of(kRangeChoices),
               "With raw noise: 3 sigma to -1..1, to 0..1, or values as they are (default raw)",
               [&](std::size_t index) {
                 auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
                 if (!raw) throw UsageError("--range applies to raw noise only; give --raw too");
                 raw->range = kRangeChoices[index].value;
               });
  flags.number("--optical-depth", "DEPTH", "Scale: density through the thickest column along the up axis",
               [&](double value) {
                 recipe.density = {value, std::nullopt, std::nullopt};
               });
  flags.number("--density", "PEAK", "Scale: the largest density, extinction per world unit",
               [&](double value) {
                 recipe.density = {DensityScale().optical_depth, value, std::nullopt};
               });
  flags.number("--density-factor", "FACTOR",
               "Scale: what densities are multiplied by, as the metadata of another volume has it",
               [&](double value) { recipe.density.factor = value; });
  flags.exclude({"--optical-depth", "--density", "--density-factor"});
  flags.number("--prune", "PART", "Leave out densities below this part of the largest one [0 to 1]",
               [&](double value) {
                 for (std::size_t i = 0; i < std::max<std::size_t>(1, recipe.grids.size()); ++i) {
                   GridRecipe& grid = grid_of(recipe, i);
                   if (!std::holds_alternative<RawShaping>(grid.shaping)) grid.prune = value;
                 }
               });
  for (const char* scale : {"--optical-depth", "--density", "--density-factor"}) {
    flags.exclude({"--raw", scale});
  }
}

void declare_cloud(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Clouds (defaults are those of the shaping \"cloud\"; presets have their own)");
  for_each_flag(CloudShaping{}, [&]<typename F, typename Owner>(F field, const Owner& owner) {
    if (field.name == "edge") field.name = "cloud_edge";  // --edge is the shape's
    declare_field(flags, field, owner, "", [field, &recipe](const ValueOf<F, Owner>& value) {
      auto* const cloud = std::get_if<CloudShaping>(&recipe.shaping);
      if (!cloud) {
        throw UsageError(
            fmt::format("{} applies to clouds only, as of --preset cumulus or smoke", flag_of(field.name)));
      }
      require(field.name, value, field.allowed, field.unit);
      field.set(*cloud, value);
    });
  });
}

void declare_shape(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Shape and resolution (1 world unit is 1 m)");
  flags.text(
      "--shape", "SHAPE",
      "box, sphere or ellipsoid: in the box; FILE.obj (or .ply, .off, .stl, .om): inside of a closed mesh; "
      "FILE.vdb[:GRID]: active voxels of a grid",
      [&](const std::string& text) { recipe.shape = parse_shape(text); });
  flags.choice("--up", names_of(kUpAxisChoices),
               "The up axis, kept in the file; shapes stand on it (default y)",
               [&](std::size_t index) { turn_up(recipe, kUpAxisChoices[index].value); });
  flags.numbers("--box", "X0 Y0 Z0 X1 Y1 Z1", 6, "Two corners, world units",
                [&](const std::vector<double>& v) {
                  recipe.box = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
                });
  flags.number(
      "--edge", "UNITS",
      "Width over which densities end at the shape's surface, world units (default two voxels; of a box 0)",
      [&](double value) { recipe.edge = value; });
  flags.number("--voxel", "SIZE", "Size of a voxel, world units",
               [&](double value) { recipe.voxel = value; });
  flags.integer("--dim", "COUNT",
                "Voxels along the box's longest side instead, the first centre on it (default 256)",
                [&](int value) {
                  recipe.dim = value;
                  recipe.voxel.reset();
                });
  flags.exclude({"--voxel", "--dim"});
}

void declare_run(FlagSet& flags, MakeOptions& options) {
  flags.group("Run");
  flags.toggle("--describe", "Print what would be made, as JSON, and write nothing",
               [&] { options.task = MakeOptions::Task::describe; });
  flags.toggle("--list-presets", "Print the presets",
               [&] { options.task = MakeOptions::Task::list_presets; });
  flags.toggle("--schema", "Print the JSON Schema of recipes, with which editors complete them", [] {});
  flags.integer("--threads", "COUNT", "Threads to use (default: all)", [&](int value) {
    require_in_range("threads", value, 1, 4096);
    options.threads = value;
  });
  flags.text("--max-memory", "SIZE", "Refuse to need more than this, such as 8G (default: what is available)",
             [&](const std::string& text) { options.max_memory = parse_bytes("--max-memory", text); });
  flags.number("--max-time", "SECONDS", "Refuse what may take longer, of each volume (default: any)",
               [&](double value) {
                 require_positive("max_time", value, "seconds");
                 options.max_time = value;
               });
  flags.toggle("--quiet", "Print errors only", [&] { options.quiet = true; });
  flags.toggle("--timings", "Print what each stage of the run took", [&] { options.timings = true; });
}

}  // namespace

void declare_make_flags(FlagSet& flags, MakeOptions& options) {
  declare_output(flags, options);
  declare_recipes(flags, options);
  declare_noise(flags, options.recipe);
  declare_parameter_flags(flags, options.recipe);
  declare_time_flags(flags, options.recipe);
  flags.group(kNoise);
  declare_generator_flag(flags, options.recipe.noise, options.recipe.dims);
  declare_shaping(flags, options.recipe);
  declare_cloud(flags, options.recipe);
  declare_layer_flags(flags, options.recipe);
  declare_shape(flags, options.recipe);
  declare_sequence_flags(flags, options);
  declare_modify_flags(flags, options.recipe);
  declare_run(flags, options);
}

void check_make_options(const FlagSet& flags, const MakeOptions& options) {
  const bool from_mesh = std::holds_alternative<MeshShape>(options.recipe.shape);
  const bool from_grid = std::holds_alternative<GridShape>(options.recipe.shape);
  if (from_grid && flags.given("--edge")) {
    throw UsageError("--edge has no effect where --shape is a grid, whose voxels are kept");
  }
  if ((from_mesh || from_grid) && flags.given("--box")) {
    throw UsageError("--box has no effect where --shape is a file; leave one of them out");
  }
  for (const char* flag : {"--voxel", "--dim"}) {
    if (from_grid && flags.given(flag)) {
      throw UsageError(fmt::format("{} has no effect where --shape is a grid, whose voxels are kept", flag));
    }
  }
  if (!options.recipe.grids.empty()) {
    for (const char* flag :
         {"--output", "--speed", "--boundary", "--boundary-width", "--grid", "--raw", "--range", "--fold",
          "--histogram", "--warp", "--optical-depth", "--density", "--density-factor", "--on"}) {
      if (!flags.given(flag)) continue;
      throw UsageError(
          fmt::format("{} has no effect where the recipe makes several grids, each with its own", flag));
    }
  }
  check_modify_flags(flags, options.recipe);
  check_layer_flags(flags, options.recipe);
  check_parameter_flags(flags, options.recipe);
  const bool raw = options.recipe.grids.empty() && std::holds_alternative<RawShaping>(options.recipe.shaping);
  for (const char* flag : {"--optical-depth", "--density", "--density-factor", "--edge", "--prune"}) {
    if (raw && flags.given(flag)) throw UsageError(fmt::format("{} has no effect on raw noise", flag));
  }
  if (options.out == "-" && options.write_recipe == "-") {
    throw UsageError("--out and --write-recipe cannot both be the standard output");
  }
}

}  // namespace solidnoise
