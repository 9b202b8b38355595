#include "meshnoise/bake_arguments.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/outputs.h"
#include "common/parse_value.h"
#include "common/recipe_files.h"
#include "meshnoise/commands.h"
#include "meshnoise/mesh_files.h"
#include "meshnoise/texture_output.h"
#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/bake_mesh.h"

namespace solidnoise {
namespace {

// What the flags leave without effect is refused rather than ignored.
void check_consistency(const FlagSet& flags, const BakeRecipe& recipe) {
  if (!recipe.steers()) {
    flags.refuse({"--by", "--percentiles", "--gamma"},
                 "has no effect where no parameter is a range; give --frequency A..B, say");
  }
  if (!has_direction(recipe.noise)) {
    flags.refuse({"--follow", "--direction", "--direction-smooth"},
                 "applies to --noise oriented and to flat exemplars only");
  }
  if (recipe.refine.mode == RefineRecipe::Mode::off) {
    flags.refuse({"--refine-shape", "--refine-method"}, "has no effect without --refine");
  }
  if (recipe.refine.mode != RefineRecipe::Mode::automatic) {
    flags.refuse({"--refine-budget"}, "has no effect without --refine auto");
  }
  const std::string lacks =
      fmt::format("does not apply to --noise {}", name_of(kSurfaceNoiseChoices, recipe.noise.kind));
  if (!has_bandwidth(recipe.noise.kind)) flags.refuse({"--bandwidth"}, lacks);
  if (!is_gabor(recipe.noise.kind)) flags.refuse({"--impulses", "--error"}, lacks);
  if (!has_layer(recipe.noise)) {
    flags.refuse({"--layer"}, "applies to --noise surface, oriented and flat exemplars only");
  }
}

void check_sequence(const FlagSet& flags, const std::string& in, const BakeOptions& options) {
  if (options.has_rest() && options.recipe.refine.mode != RefineRecipe::Mode::off) {
    throw UsageError(
        "--rest and --rest-property are of the same vertices; leave --refine out, or refine before");
  }
  if (options.has_rest() && options.recipe.displace != 0.0) {
    throw UsageError("--rest does not go with --displace, which moves vertices from where they are at rest");
  }
  if (options.frames.empty()) {
    flags.refuse({"--fps"}, "has no effect without --frames");
    refuse_frame_number("IN", in);
    refuse_frame_number("--out", options.out);
    refuse_frame_number("--uv", options.uv);
    return refuse_frame_number("--preview", options.preview);
  }
  if (!options.recipe.changes_with_time() && !has_frame_number(in)) {
    throw UsageError(
        "--frames has no effect on a noise that does not change; give --evolve, --dims 4 or a mesh of each "
        "frame "
        "(in.####.ply) too");
  }
  if (in == "-" || options.out == "-") throw UsageError("--frames needs files, such as out.####.ply");
}

// One frame of a sequence, and the mesh that it is made on.
BakeOptions options_of_frame(const BakeOptions& options, int frame, std::string& in) {
  BakeOptions result = options;
  if (has_frame_number(in)) in = frame_path("IN", in, frame);
  if (!result.out.empty()) result.out = frame_path("--out", options.out, frame);
  if (!result.uv.empty()) result.uv = frame_path("--uv", options.uv, frame);
  if (!result.preview.empty()) result.preview = frame_path("--preview", options.preview, frame);
  if (frame != options.frames.front()) result.write_recipe.clear();
  if (options.recipe.changes_with_time()) {
    result.recipe.noise.time += frame_time(frame, options.fps, options.recipe.noise.loop);
  }
  return result;
}

}  // namespace

BakeArguments::BakeArguments(const std::string& command, const std::string& description)
    : flags(command, description) {
  flags.optional_argument(
      "IN", "The mesh: .ply, .obj, .off, .stl, .om, .glb or .gltf, - for a .ply on the standard input", in);
  declare_bake_flags(flags, options);
  flags.version(kMeshnoise);
}

void BakeArguments::apply(const BakeRecipe& start) {
  options.recipe = start;
  explained(flags, [&] {
    flags.apply();
    if (in.empty()) throw UsageError("IN is missing; say which mesh: meshnoise bake in.ply --out out.ply");
    check_consistency(flags, options.recipe);
    check_sequence(flags, in, options);
    options.recipe.validate();
    require_keepable(options.keep, options.recipe);
  });
}

std::size_t frame_count(const BakeArguments& arguments) {
  return std::max<std::size_t>(1, arguments.options.frames.size());
}

BakeFrame frame_of(const BakeArguments& arguments, std::size_t index) {
  BakeFrame frame{arguments.in, arguments.options};
  if (arguments.options.frames.empty()) return frame;
  frame.options = options_of_frame(arguments.options, arguments.options.frames[index], frame.in);
  frame.is_first = index == 0;
  return frame;
}

void check_outputs(const FlagSet& flags, const BakeFrame& frame) {
  const auto& [in, options, is_first] = frame;
  if (options.out.empty() && options.uv.empty() && options.preview.empty() && options.write_recipe.empty()) {
    throw UsageError("--out is missing; say where the mesh goes: --out out.ply");
  }
  check_textures(options);
  if (options.uv.empty()) {
    flags.refuse({"--map", "--uv-size", "--uv-padding"}, "has no effect without --uv");
  }
  if (options.out == "-" && options.write_recipe == "-") {
    throw UsageError("--out and --write-recipe cannot both be the standard output");
  }
  const bool displaces = options.recipe.displace != 0.0;
  if (!options.out.empty()) require_mesh_name(options.out, displaces ? Shows::shape : Shows::colors);
  if (!options.keep.empty() && !holds_numbers(options.out)) {
    throw UsageError(
        "--keep has no effect where --out is no .ply, .om, .glb or .usda, which alone hold such numbers");
  }
  if (!options.preview.empty()) require_preview(options.preview);
  if (options.preview.empty()) {
    flags.refuse({"--preview-size", "--preview-turn", "--preview-elevation"},
                 "has no effect without --preview");
  }
  require_extension("--write-recipe", options.write_recipe, {".json"}, StandardOutput::allowed);
  const RecipeInputs read = recipe_inputs(flags);
  if (options.usd) require_usd(options.out);
  require_outputs({{options.out, {in}},
                   options.usd ? usd_path(options.out) : std::string(),
                   options.preview,
                   {options.write_recipe, {read.recipe}}},
                  options.existing(), {in, read.recipe, read.noise, options.rest});
}

}  // namespace solidnoise
