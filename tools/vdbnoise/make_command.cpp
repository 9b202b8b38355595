#include <iostream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/outputs.h"
#include "common/run_tool.h"
#include "solidnoise/volume/describe_volume.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/grid_flags.h"
#include "vdbnoise/make_arguments.h"
#include "vdbnoise/make_files.h"
#include "vdbnoise/usd_output.h"

namespace solidnoise {
namespace {

constexpr char kMakeDescription[] =
    "vdbnoise makes volumes of procedural noise, as OpenVDB files.\n"
    "  vdbnoise --preset smoke --seed 7 --dim 384 --out smoke.vdb --preview smoke.png   makes smoke\n"
    "  vdbnoise merge FILE... --out whole.vdb   joins parts made by --shard or --region\n"
    "  vdbnoise farm --parts 64 --out sky.vdb   has many machines make parts and join them\n"
    "  vdbnoise surface MESH --out surface.vdb  makes the level set of a mesh\n"
    "  vdbnoise sky --out sky.usda              makes a sky of clouds, and a scene that places them\n"
    "  vdbnoise slice --out noise.png           makes a picture of a plane, or a line of samples\n"
    "  vdbnoise info FILE                       prints a file's grids and recipe\n"
    "  vdbnoise analyze FILE                    measures a grid and compares it with the theory";

// Makes the frames one after the other. One that fails leaves the others; an interruption ends all.
void make_sequence(MakeOptions options) {
  const bool makes_volumes = !options.out.empty() || !options.preview.empty();
  for (std::size_t i = 0; makes_volumes && i < options.frames.size(); ++i) {
    check_outputs(options_of_frame(options, i));
  }
  if (options.usd) require_outputs({usd_scene_path(options.out)}, options.existing());
  MakeOptions recipe_only = options;
  recipe_only.out.clear();
  recipe_only.usd = false;
  recipe_only.preview.clear();
  if (!options.write_recipe.empty()) check_outputs(recipe_only);
  if (scales_each_frame(options) && !options.quiet) {
    std::cerr << "vdbnoise: warning: each frame has a grid of its own and is scaled by itself, which may "
                 "flicker; --density-factor gives all one scale\n";
  }
  if (shares_density_factor(options)) measure_density_factors(options);
  if (!options.write_recipe.empty()) {
    recipe_only.recipe = options.recipe;
    make_volume_files(recipe_only);
    if (!makes_volumes) return;
  }
  std::size_t failed = 0;
  UsdScene scene;
  for (std::size_t i = 0; i < options.frames.size(); ++i) {
    try {
      if (i > failed) {
        set_what_is_left(
            fmt::format("nothing is written of frame {}; frames before it are", options.frames[i]));
      }
      make_volume_files(options_of_frame(options, i), options.usd ? &scene : nullptr);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::runtime_error& error) {
      ++failed;
      std::cerr << fmt::format("vdbnoise: frame {}: {}\n", options.frames[i], error.what());
    }
  }
  if (failed == 0 && options.usd) write_scene(scene, options, nullptr);
  if (failed == 0) return;
  throw std::runtime_error(fmt::format("{} of {} frames failed", failed, options.frames.size()));
}

// Reads the grid that frames previews, if one is named.
void read_preview_frame(MakeOptions& options) {
  constexpr const char* kFlag = "--preview-frame";
  if (!options.frame_source) return;
  if (options.preview.empty() || recipes_of_grids(options.recipe).front().output.front() != Output::value) {
    throw UsageError(fmt::format("{} has no effect without a --preview of values", kFlag));
  }
  const EndsAtOnce ends_at_once;
  options.preview_frame = read_float_grid(*options.frame_source, kFlag);
}

int make(MakeOptions options) {
  catch_interrupts();
  read_preview_frame(options);
  const auto threads = options.limit_threads();
  if (options.frames.empty()) {
    check_outputs(options);
    make_volume_files(options);
  } else {
    make_sequence(options);
  }
  if (options.timings) std::cerr << options.times->report();
  return kDone;
}

}  // namespace

int run_make(const std::vector<std::string>& arguments) {
  MakeArguments read("vdbnoise", kMakeDescription);
  read.flags.parse(arguments);
  read.apply(explained(read.flags, [&] { return read.start(); }));
  const MakeOptions& options = read.options;
  return explained(read.flags, [&] {
    if (!read.flags.given("--describe")) return make(options);
    std::cout << format_json(describe_volume(
        options.recipe, {options.part, static_cast<double>(options.memory_limit()), target_of(options)}));
    return kDone;
  });
}

}  // namespace solidnoise
