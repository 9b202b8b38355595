#include "common/noise_flags.h"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/recipe/exemplar_file.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {
namespace {

// A noise by example is named by its file.
constexpr auto kIsNamed = []<typename Options>(std::type_identity<Options>) { return !IsByExample<Options>; };

// Another noise, with what the old one and it have in common.
void change_noise(NoiseRecipe& recipe, NoiseRecipe changed) {
  const auto copy = [](const auto& from, auto& to) {
    for_each_flag(from,
                  [&](const auto& field, const auto& owner) { set_field(to, field.name, field.get(owner)); });
  };
  std::visit(copy, recipe.noise, changed.noise);
  recipe = std::move(changed);
}

// The noise of an exemplar's model, which needs no octaves: it has all scales that the exemplar has.
NoiseRecipe noise_by_example(const std::string& file) {
  ExemplarFile example;
  read_recipe(file, read_text_file(file), [&](const Json& json) { example = exemplar_file_of(json); });
  SpectrumNoiseOptions options;
  if (const auto frequency = example.true_frequency()) options.frequency = *frequency;
  options.model = std::move(example.model);
  return {options, {}};
}

std::string noise_help() {
  std::string help;
  for_each_noise([&]<typename Options>(std::type_identity<Options>) {
    using Entry = NoiseEntry<Options>;
    help += IsByExample<Options> ? "FILE.json of noisefit" : std::string(Entry::kName);
    help += fmt::format(": {}; ", Entry::kHelp);
  });
  return help.substr(0, help.size() - 2);
}

}  // namespace

void change_noise_type(NoiseRecipe& recipe, const std::string& type) {
  if (noise_type(recipe) == type) return;
  NoiseRecipe changed = default_noise(type);
  changed.fractal = recipe.fractal;
  change_noise(recipe, std::move(changed));
}

std::vector<std::string> declare_noise_flags(FlagSet& flags, NoiseRecipe& recipe) {
  const auto choose = [&recipe](const std::string& noise) {
    if (extension_of(noise) == ".json") return change_noise(recipe, noise_by_example(noise));
    const std::vector<std::string_view> names = noise_names(kIsNamed);
    if (std::find(names.begin(), names.end(), noise) == names.end()) {
      throw UsageError(fmt::format("--noise is {}; it must be one of {}, or FILE.json of noisefit",
                                   printable(noise), fmt::join(names, ", ")));
    }
    change_noise_type(recipe, noise);
  };
  Flag& kind = flags.text("--noise", "KIND", noise_help(), choose);
  kind.standard = [&] { return std::string(noise_type(recipe)); };
  kind.words = noise_names(kIsNamed);
  std::vector<std::string> declared =
      declare_alternatives(flags, recipe.noise, {noise_names(), "{} does not apply to --noise {}"});
  declare_fields(flags, recipe.fractal);
  const auto set_size = [&recipe](double size) {
    require_in_range("--size", size, 1e-12, 1e12, "world units");
    std::visit([size](auto& options) { options.frequency = 1.0 / size; }, recipe.noise);
  };
  flags.number("--size", "UNITS", "Instead of the frequency: size of a feature [world units]", set_size);
  flags.exclude({"--frequency", "--size"});
  for (const char* flag : {"--noise", "--size", "--no-renormalize"}) declared.push_back(flag);
  for_each_flag(recipe.fractal, [&](const auto& field, auto&) { declared.push_back(flag_of(field.name)); });
  return declared;
}

void declare_generator_flag(FlagSet& flags, NoiseRecipe& recipe, const int& dims) {
  const auto choose = [&recipe, &dims](std::size_t index) {
    if (index == 0) return;
    if (!has_generators(recipe)) {
      throw UsageError(
          "--generator auto needs --noise gabor with weights of 1 and -1, or gabor-oriented "
          "without anisotropy");
    }
    recipe = cheapest_generator(recipe, dims);
  };
  flags.choice("--generator", {"named", "auto"},
               "gabor, gabor-oriented without anisotropy: the noise that is named, or of the two the one "
               "that is cheaper at the same likeness to a Gaussian field (default named)",
               choose);
}

std::string loop_warning(const Evolution& evolution) {
  constexpr double kLeastCorrelation = -0.25;
  constexpr double kTurns = 2.0;  // of which the correlation is -0.20
  if (evolution.loop == 0.0) return {};
  const double correlation = evolution_correlation(evolution, 0.5 * evolution.loop);
  if (correlation > kLeastCorrelation) return {};
  return fmt::format(
      "half a loop later the noise is much like its own negative (correlation {:.2f}), for its impulses turn "
      "about "
      "once; --evolve {:.3g} or --loop {:.3g} has less of that\n",
      correlation, kTurns / evolution.loop, kTurns / evolution.rate);
}

}  // namespace solidnoise
