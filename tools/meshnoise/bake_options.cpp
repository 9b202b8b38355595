#include "meshnoise/bake_options.h"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/flag_set.h"
#include "common/parse_value.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/recipe/exemplar_model_json.h"

namespace solidnoise {
namespace {

// "4" or "4..32".
ParameterRange parse_range(const std::string& flag, const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) {
    const double value = parse_number(flag, text);
    return {value, value};
  }
  try {
    return {parse_number(flag, text.substr(0, dots)), parse_number(flag, text.substr(dots + 2))};
  } catch (const UsageError&) {
    throw UsageError(
        fmt::format("{} is {}; it must be a number, or two with dots between them, such as 4..32", flag,
                    printable(text)));
  }
}

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
    if (!is_number) {
      throw UsageError(fmt::format("--refine is {}; it must be auto, off or a number of rounds",
                                   text.empty() ? "empty" : printable(text)));
    }
    refine.mode = RefineRecipe::Mode::rounds;
    refine.rounds = parse_integer("--refine", text);
  }
}

std::vector<std::string> parse_names(const std::string& flag, const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  if (names.empty() || std::count(names.begin(), names.end(), "") > 0) {
    throw UsageError(fmt::format("{} is {}; it must be names with commas between them", flag,
                                 text.empty() ? "empty" : printable(text)));
  }
  return names;
}

void declare_output(FlagSet& flags, BakeOptions& options) {
  flags.group("Output");
  keep(
      flags, "--out", "FILE",
      "Where the mesh goes: .ply, .obj, .off or .om, with --displace also .stl; - for a .ply on the standard "
      "output",
      options.out);
  keep(flags, "--preview", "FILE.png", "A picture of the mesh in its colours, rendered by Embree",
       options.preview);
  flags.toggle("--force", "Replace files that exist", [&] { options.existing = Existing::replace; });
  flags.text("--keep", "NAMES",
             fmt::format("Numbers to put into a .ply or .om, with commas between: {}",
                         fmt::join(keepable_names(), ", ")),
             [&](const std::string& text) { options.keep = parse_names("--keep", text); });
}

void declare_recipes(FlagSet& flags, BakeOptions& options) {
  flags.group("Recipes");
  flags.text("--preset", "NAME", "Start from a recipe that comes with the program (default rust)",
             [](const std::string&) {});
  flags.text("--recipe", "FILE",
             "Start from a recipe, .json, or from that of a .ply, .obj or .off made by meshnoise",
             [](const std::string&) {});
  keep(flags, "--write-recipe", "FILE.json",
       "Write the recipe with all flags in it; - for the standard output", options.write_recipe);
  flags.exclude({"--preset", "--recipe"});
}

void declare_range(FlagSet& flags, const std::string& flag, const std::string& unit, const std::string& help,
                   const std::function<void(const ParameterRange&)>& set) {
  flags.text(flag, unit, help, [=](const std::string& text) { set(parse_range(flag, text)); });
}

// A noise by example has one frequency and the colours of the exemplar: what a preset says of other noises
// does not suit it.
void take_example(BakeRecipe& recipe, const std::string& file) {
  const std::uint64_t seed = recipe.noise.seed;
  recipe.noise = {};
  recipe.noise.kind = SurfaceNoiseKind::spectrum;
  recipe.noise.seed = seed;
  read_recipe(file, read_text_file(file),
              [&](const Json& json) { recipe.noise.exemplar = exemplar_file_from_json(json); });
  recipe.frequency.reset();
  recipe.detail = recipe.bandwidth = recipe.magnitude = {1.0, 1.0};
  recipe.bias = {0.0, 0.0};
  recipe.ramp = kExemplarRamp;
  recipe.contrast = 1.0;
}

void choose_noise(BakeRecipe& recipe, const std::string& noise) {
  if (noise.ends_with(".json")) return take_example(recipe, noise);
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
      "example (default surface)",
      [&](const std::string& noise) { choose_noise(recipe, noise); });
  declare_range(flags, "--frequency", "A[..B]",
                "Principal frequency, cycles per world unit; a range follows --by (default: suits the mesh)",
                [&](const ParameterRange& range) {
                  recipe.frequency = range;
                  recipe.detail = {};
                });
  declare_range(flags, "--size", "A[..B]", "Instead: size of a feature, world units; 1 / frequency",
                [&](const ParameterRange& range) {
                  require_positive("size", range.from, "world units");
                  require_positive("size", range.to, "world units");
                  recipe.frequency = ParameterRange{1.0 / range.from, 1.0 / range.to};
                  recipe.detail = {};
                });
  declare_range(flags, "--detail", "A[..B]", "Instead: frequency over what suits the mesh (default 1)",
                [&](const ParameterRange& range) {
                  recipe.frequency.reset();
                  recipe.detail = range;
                });
  flags.exclude({"--frequency", "--size", "--detail"});
  for_each_field(recipe, [&]<typename Owner>(const auto& field, Owner& owner) {
    if constexpr (std::same_as<ValueOf<decltype(field), Owner>, ParameterRange>) {
      if (field.name == "detail") return;
      const auto defaults = std::make_unique<Owner>();
      const std::string standard = fmt::format("{}", field.get(*defaults).from);
      declare_range(flags, flag_of(field.name), "A[..B]",
                    help_of(field.help, field.unit, field.allowed, standard),
                    [field, &owner](const ParameterRange& range) { field.set(owner, range); });
    }
  });
  declare_fields(flags, recipe.noise);
}

void declare_steering(FlagSet& flags, BakeRecipe& recipe) {
  flags.group("What ranges follow");
  flags.text("--by", "WORD",
             fmt::format("{}, or the name of a number of the vertices (default mean-curvature)",
                         fmt::join(names_of(kSteeringChoices), ", ")),
             [&](const std::string& text) { set_source(recipe.by, text); });
  declare_fields(flags, recipe.by);
  declare_fields(flags, recipe, {"smooth", "smooth_radius", "up"});
}

void declare_direction(FlagSet& flags, BakeRecipe& recipe) {
  flags.group("Direction of oriented noise");
  declare_choice(flags, "--follow", kDirectionChoices,
                 "Waves travel along --direction, or along a principal curvature (default axis)",
                 recipe.direction.source);
  flags.numbers("--direction", "X Y Z", 3, "An axis, laid into the tangent plane (default 0 1 0)",
                [&](const std::vector<double>& v) {
                  recipe.direction.axis = {v[0], v[1], v[2]};
                });
  flags.integer("--direction-smooth", "ROUNDS",
                "Smoothing of a direction that follows the curvature (default 10)",
                [&](int value) { recipe.direction.smooth = value; });
}

void declare_look(FlagSet& flags, BakeRecipe& recipe) {
  flags.group("Look");
  flags.text(
      "--ramp", "RAMP",
      fmt::format(
          "{}, or stops such as 0:#000,1:#fff; sRGB, blended in linear light; or exemplar (default rust)",
          fmt::join(ramp_names(), ", ")),
      [&](const std::string& text) {
        if (text != kExemplarRamp) parse_color_ramp(text);
        recipe.ramp = text;
      });
  declare_fields(flags, recipe, {"contrast", "displace"});
  flags.text("--refine", "auto|N", "Split edges until the noise shows on the mesh, or N times (default off)",
             [&](const std::string& text) { set_refine(recipe.refine, text); });
  declare_choice(
      flags, "--refine-method", kRefineMethodChoices,
      "With --refine: our own, for any mesh, or OpenMesh's, for manifolds of triangles; sqrt3 and loop "
      "smooth (default own)",
      recipe.refine.method);
  declare_choice(flags, "--refine-shape", kPlacementChoices,
                 "With --refine: new vertices lie on the edges, or on the smooth surface through their ends "
                 "(default edges)",
                 recipe.refine.placement);
}

void declare_run(FlagSet& flags, BakeOptions& options) {
  flags.group("Run");
  flags.toggle("--describe", "Print what would be made, as JSON, and write nothing",
               [&] { options.task = BakeOptions::Task::describe; });
  flags.toggle("--list-presets", "Print the presets",
               [&] { options.task = BakeOptions::Task::list_presets; });
  flags.toggle("--schema", "Print the JSON Schema of recipes, with which editors complete them", [] {});
  flags.integer("--threads", "COUNT", "Threads to use (default: all)", [&](int value) {
    require_in_range("threads", value, 1, 4096);
    options.threads = value;
  });
  flags.text("--max-memory", "SIZE", "Refuse to need more than this, such as 8G (default: what is available)",
             [&](const std::string& text) { options.max_memory = parse_bytes("--max-memory", text); });
  flags.number("--max-time", "SECONDS", "Refuse what may take longer (default: any)", [&](double value) {
    require_positive("max_time", value, "seconds");
    options.max_time = value;
  });
  flags.toggle("--quiet", "Print errors only", [&] { options.quiet = true; });
  flags.toggle("--timings", "Print what each stage of the run took", [&] { options.timings = true; });
}

}  // namespace

void declare_bake_flags(FlagSet& flags, BakeOptions& options) {
  declare_output(flags, options);
  declare_recipes(flags, options);
  declare_noise(flags, options.recipe);
  declare_steering(flags, options.recipe);
  declare_direction(flags, options.recipe);
  declare_look(flags, options.recipe);
  declare_run(flags, options);
}

}  // namespace solidnoise
