#include "meshnoise/bake_options.h"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/frames.h"
#include "common/parse_value.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/recipe/exemplar_file.h"

namespace solidnoise {

// "4" or "4..32".
template <>
struct FlagForm<ParameterRange> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "A[..B]"; }
  static ParameterRange read(const std::string& flag, const std::vector<std::string>& texts) {
    const std::string& text = texts[0];
    const std::size_t dots = text.find("..");
    if (dots == std::string::npos) {
      const double value = parse_number(flag, text);
      return {value, value};
    }
    try {
      return {parse_number(flag, text.substr(0, dots)), parse_number(flag, text.substr(dots + 2))};
    } catch (const UsageError&) {
      refuse_value(flag, text, "a number, or two with dots between them, such as 4..32");
    }
  }
  static std::string write(const ParameterRange& range) {
    return range.varies() ? fmt::format("{}..{}", range.from, range.to) : fmt::format("{}", range.from);
  }
};

namespace {

// An attribute is any other word.
void set_source(Steering& steering, const std::string& text) {
  steering.attribute.clear();
  for (const auto& choice : kSteeringChoices) {
    if (choice.name != text) continue;
    steering.source = choice.value;
    return;
  }
  if (text.empty()) throw UsageError("--by is empty; it must be a word");
  steering.source = SteeringSource::attribute;
  steering.attribute = text;
}

void set_refine(RefineRecipe& refine, const std::string& text) {
  if (text == "off") {
    refine.mode = RefineRecipe::Mode::off;
  } else if (text == "auto") {
    refine.mode = RefineRecipe::Mode::automatic;
  } else {
    const bool is_number = !text.empty() && text.find_first_not_of("+-0123456789") == std::string::npos;
    if (!is_number) refuse_value("--refine", text, "auto, off or a number of rounds");
    refine.mode = RefineRecipe::Mode::rounds;
    refine.rounds = parse_integer("--refine", text);
  }
}

std::vector<std::string> parse_names(const std::string& flag, const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  if (names.empty() || std::count(names.begin(), names.end(), "") > 0) {
    refuse_value(flag, text, "names with commas between them");
  }
  return names;
}

void declare_output(FlagSet& flags, BakeOptions& options) {
  flags.group("Output");
  flags.keep("--out", "FILE",
             "Where the mesh goes: .ply, .obj, .off or .om, with --displace also .stl, for scenes .glb or "
             ".usda; - for "
             "a .ply on the standard output",
             options.out);
  flags.toggle("--usd", "Write the mesh as USD too: a .usda beside --out", [&] { options.usd = true; });
  flags.keep("--uv", "FILE",
             "Textures instead, or too, of a mesh that has texture coordinates: .png and .tif of 16 bits, "
             ".exr; one of "
             "the coordinates from 0 to 1, or of each tile where its name has <UDIM> in it",
             options.uv);
  flags.text(
      "--map", "NAMES",
      "What textures show, with commas between: color, normal, height, noise, or a property of the recipe, "
      "such as roughness; of several, <MAP> in --uv is the name (default color)",
      [&](const std::string& text) { options.maps = parse_names("--map", text); });
  declare_fields(flags, options.textures);
  flags.keep("--preview", "FILE.png", "A picture of the mesh in its colours, rendered by Embree",
             options.preview);
  declare_fields(flags, options.view);
  declare_fields<RunOptions>(flags, options, {"force"});
  flags.text("--keep", "NAMES",
             fmt::format("Numbers to put into a .ply, .om, .glb or .usda, with commas between: {}",
                         fmt::join(keepable_names(), ", ")),
             [&](const std::string& text) { options.keep = parse_names("--keep", text); });
}

// A noise by example has the frequency and the colours of the exemplar: what a preset says of other noises
// does not suit it.
void take_example(BakeRecipe& recipe, const std::string& file) {
  const std::uint64_t seed = recipe.noise.seed;
  recipe.noise = {};
  recipe.layers.clear();
  recipe.fields.clear();
  recipe.properties.clear();
  recipe.noise.kind = SurfaceNoiseKind::spectrum;
  recipe.noise.seed = seed;
  ExemplarFile example;
  read_recipe(file, read_text_file(file), [&](const Json& json) { example = exemplar_file_of(json); });
  recipe.frequency.reset();
  if (const auto frequency = example.true_frequency()) recipe.frequency = {*frequency, *frequency};
  recipe.feature_size.reset();
  recipe.noise.exemplar = std::move(example.model);
  recipe.detail = recipe.bandwidth = recipe.magnitude = {1.0, 1.0};
  recipe.bias = {0.0, 0.0};
  recipe.ramp = kExemplarRamp;
  recipe.contrast = 1.0;
}

void choose_noise(BakeRecipe& recipe, const std::string& noise) {
  if (extension_of(noise) == ".json") return take_example(recipe, noise);
  std::vector<std::string_view> names = names_of(kSurfaceNoiseChoices);
  names.pop_back();  // an exemplar is given by its file
  const auto found = std::find(names.begin(), names.end(), noise);
  if (found == names.end()) {
    throw UsageError(fmt::format("--noise is {}; it must be one of {}, or FILE.json of noisefit",
                                 printable(noise), fmt::join(names, ", ")));
  }
  recipe.noise.kind = kSurfaceNoiseChoices[static_cast<std::size_t>(found - names.begin())].value;
}

void declare_noise(FlagSet& flags, BakeRecipe& recipe) {
  flags.group("Noise");
  flags.text(
      "--noise", "KIND",
      "surface: of the tangent plane; oriented: its waves follow a direction; solid: the field that "
      "volumes have; kensler, kensler-solid: gradient noise, projected or solid; FILE.json of noisefit: by "
      "example; without a preset, alone (default surface)",
      [&](const std::string& noise) { choose_noise(recipe, noise); });
  declare_field(flags, recipe, "frequency", [&](const std::optional<ParameterRange>& range) {
    recipe.frequency = range;
    recipe.feature_size.reset();
    recipe.detail = {};
  });
  flags.add({"--size", FlagForm<ParameterRange>::names({}),
             "Instead: size of a feature; a range follows --by [world units]",
             [&](const std::vector<std::string>& texts) {
               const ParameterRange range = FlagForm<ParameterRange>::read("--size", texts);
               for (const double size : {range.from, range.to}) {
                 require_in_range("--size", size, 1e-9, 1e9, "world units");
               }
               recipe.frequency = ParameterRange{1.0 / range.from, 1.0 / range.to};
               recipe.feature_size.reset();
               recipe.detail = {};
             }});
  declare_field(flags, recipe, "feature_size", [&](const std::optional<double>& size) {
    recipe.frequency.reset();
    recipe.feature_size = size;
  });
  declare_field(flags, recipe, "detail", [&](const ParameterRange& range) {
    recipe.frequency.reset();
    recipe.detail = range;
  });
  flags.exclude({"--frequency", "--size", "--detail"});
  flags.exclude({"--frequency", "--size", "--feature-size"});
  declare_fields(flags, recipe, {"bandwidth", "magnitude", "bias"});
  declare_fields(flags, recipe.noise);
}

void declare_steering(FlagSet& flags, BakeRecipe& recipe) {
  flags.group("What ranges follow");
  flags
      .text("--by", "WORD",
            fmt::format("{}, or the name of a number of the vertices (default mean-curvature)",
                        fmt::join(names_of(kSteeringChoices), ", ")),
            [&](const std::string& text) { set_source(recipe.by, text); })
      .words = names_of(kSteeringChoices);
  declare_fields(flags, recipe.by, {"percentiles", "gamma"});
  declare_fields(flags, recipe, {"smooth", "smooth_radius", "up"});
}

// Declares the flag of a field under another name; it sets the field.
template <typename Struct, typename Value>
void declare_as(FlagSet& flags, const std::string& flag, Struct& object, std::string_view name,
                Value Struct::*member) {
  declare_field(flags, object, name, {flag},
                [&object, member](const Value& value) { object.*member = value; });
}

void declare_direction(FlagSet& flags, DirectionRecipe& direction) {
  flags.group("Direction of oriented noise");
  declare_as(flags, "--follow", direction, "source", &DirectionRecipe::source);
  declare_as(flags, "--direction", direction, "axis", &DirectionRecipe::axis);
  declare_as(flags, "--direction-smooth", direction, "smooth", &DirectionRecipe::smooth);
}

void declare_look(FlagSet& flags, BakeRecipe& recipe) {
  flags.group("Look");
  flags
      .text(
          "--ramp", "RAMP",
          fmt::format(
              "{}, or stops such as 0:#000,1:#fff; sRGB, blended in linear light; or exemplar (default rust)",
              fmt::join(ramp_names(), ", ")),
          [&](const std::string& text) {
            if (text != kExemplarRamp) parse_color_ramp(text);
            recipe.ramp = text;
          })
      .words = ramp_names();
  declare_fields(flags, recipe, {"contrast", "displace"});
  flags.text("--refine", "auto|N", "Split edges until the noise shows on the mesh, or N times (default off)",
             [&](const std::string& text) { set_refine(recipe.refine, text); });
  declare_as(flags, "--refine-budget", recipe.refine, "budget", &RefineRecipe::budget);
  declare_as(flags, "--refine-method", recipe.refine, "method", &RefineRecipe::method);
  declare_as(flags, "--refine-shape", recipe.refine, "placement", &RefineRecipe::placement);
}

}  // namespace

void declare_bake_flags(FlagSet& flags, BakeOptions& options) {
  flags.show_first({"--out", "--uv", "--preset", "--preview", "--noise", "--frequency", "--seed", "--by",
                    "--ramp", "--refine", "--displace"});
  declare_output(flags, options);
  declare_recipe_flags(flags, "a .ply, .obj or .off made by meshnoise", options.write_recipe,
                       bake_recipe_schema);
  declare_noise(flags, options.recipe);
  declare_steering(flags, options.recipe);
  declare_direction(flags, options.recipe.direction);
  declare_look(flags, options.recipe);
  flags.group("Sequences");
  declare_frame_flags(flags, "out.####.ply; IN may be, too", options.frames, options.fps);
  flags.keep("--rest", "FILE",
             "The mesh before it was deformed, of the same vertices: the noise is where they were there",
             options.rest);
  flags.keep("--rest-property", "NAME",
             "The same by the vertices' numbers NAME_x, NAME_y and NAME_z, or NAMEx, NAMEy and NAMEz",
             options.rest_property);
  flags.exclude({"--rest", "--rest-property"});
  flags.group("Run");
  flags.add({"--describe", "", "Print what would be made, as JSON, and write nothing"});
  declare_fields<RunOptions>(flags, options, {"threads", "max_memory", "max_time", "quiet", "timings"});
  flags.footer("Defaults are those of the recipe to start from: meshnoise bake --preset scales --help ramp");
}

}  // namespace solidnoise
