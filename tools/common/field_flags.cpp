#include "common/field_flags.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {

std::string flag_of(std::string_view field) {
  std::string flag = "--" + std::string(field);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string number_name(std::string_view unit) {
  if (unit.starts_with("world units")) return "UNITS";
  std::string name(unit.substr(0, unit.find(" per ")));
  if (name.empty() || name.find(' ') != std::string::npos) return "NUMBER";
  for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return name;
}

std::string help_of(std::string_view help, std::string_view unit, const Interval& allowed,
                    const std::string& default_value) {
  std::string range(unit);
  if (std::isfinite(allowed.most)) {
    range += fmt::format("{}{:g} to {:g}", unit.empty() ? "" : "; ", allowed.least, allowed.most);
  }
  std::string text(help);
  if (!range.empty()) text += fmt::format(" [{}]", range);
  if (!default_value.empty()) text += fmt::format(" (default {})", default_value);
  return text;
}

std::string format_numbers(std::vector<double> numbers) {
  while (numbers.size() > 3 && numbers.back() == 0.0) numbers.pop_back();
  return fmt::format("{:g}", fmt::join(numbers, " "));
}

namespace {

constexpr auto kAll = [](auto) { return true; };
// A noise by example is named by its file.
constexpr auto kIsNamed = []<typename Options>(std::type_identity<Options>) { return !IsByExample<Options>; };

// Sets the field of a name, if there is one with a flag, of the same type.
template <typename Options, typename Value>
bool set_field(Options& options, std::string_view name, const Value& value) {
  bool is_set = false;
  for_each_flag(options, [&]<typename Owner>(const auto& field, Owner& owner) {
    if constexpr (std::same_as<ValueOf<decltype(field), Owner>, Value>) {
      if (field.name != name) return;
      field.set(owner, value);
      is_set = true;
    }
  });
  return is_set;
}

template <typename Value>
void assign(const std::string& flag, NoiseRecipe& recipe, std::string_view name, const Value& value) {
  const auto set = [&](auto& options) { return set_field(options, name, value); };
  if (std::visit(set, recipe.noise)) return;
  throw UsageError(fmt::format("{} does not apply to --noise {}", flag, noise_type(recipe)));
}

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
  SpectrumNoiseOptions options;
  read_recipe(file, read_text_file(file),
              [&](const Json& json) { options.model = exemplar_file_from_json(json); });
  return {options, {}};
}

void choose_noise(NoiseRecipe& recipe, const std::string& noise) {
  if (noise.ends_with(".json")) return change_noise(recipe, noise_by_example(noise));
  const std::vector<std::string_view> names = noise_names(kIsNamed);
  if (std::find(names.begin(), names.end(), noise) == names.end()) {
    throw UsageError(fmt::format("--noise is {}; it must be one of {}, or FILE.json of noisefit",
                                 printable(noise), fmt::join(names, ", ")));
  }
  if (noise_type(recipe) == noise) return;
  NoiseRecipe changed = default_noise(noise);
  changed.fractal = recipe.fractal;
  change_noise(recipe, std::move(changed));
}

// The names of the noises that have a field.
std::vector<std::string_view> noises_with(std::string_view name) {
  return noise_names([&]<typename Options>(std::type_identity<Options>) {
    bool has = false;
    for_each_flag(Options{}, [&](const auto& field, const auto&) { has = has || field.name == name; });
    return has;
  });
}

// Calls visit(field, owner) for each name of a field once, that of the first noise that has it.
template <typename Visit>
void for_each_flag_of_noises(const Visit& visit) {
  for_each_noise([&]<typename Options>(std::type_identity<Options>) {
    for_each_flag(Options{}, [&](const auto& field, const auto& owner) {
      if (noises_with(field.name).front() == NoiseEntry<Options>::kName) visit(field, owner);
    });
  });
}

void declare_size(FlagSet& flags, NoiseRecipe& recipe) {
  flags.number("--size", "UNITS", "Instead of the frequency: size of a feature, world units; 1 / frequency",
               [&recipe](double size) {
                 require_positive("size", size, "world units");
                 assign("--size", recipe, "frequency", 1.0 / size);
               });
  flags.exclude({"--frequency", "--size"});
}

std::string noise_help() {
  std::string help;
  for_each_noise([&]<typename Options>(std::type_identity<Options>) {
    using Entry = NoiseEntry<Options>;
    help += IsByExample<Options> ? "FILE.json of noisefit" : std::string(Entry::kName);
    help += fmt::format(": {}; ", Entry::kHelp);
  });
  return help.substr(0, help.size() - 2) + " (default gabor)";
}

}  // namespace

void change_noise_type(NoiseRecipe& recipe, const std::string& type) {
  choose_noise(recipe, type);
}

void declare_noise_flags(FlagSet& flags, NoiseRecipe& recipe) {
  flags.text("--noise", "KIND", noise_help(),
             [&recipe](const std::string& noise) { choose_noise(recipe, noise); });
  for_each_flag_of_noises([&]<typename Owner>(const auto& field, const Owner& owner) {
    using Value = ValueOf<decltype(field), Owner>;
    const auto noises = noises_with(field.name);
    const bool is_of_all = noises.size() == noise_names(kAll).size();
    const std::string before = is_of_all ? "" : fmt::format("{}: ", fmt::join(noises, ", "));
    declare_field(flags, field, owner, before,
                  [flag = flag_of(field.name), name = field.name, &recipe](const Value& value) {
                    assign(flag, recipe, name, value);
                  });
    if (field.name == "frequency") declare_size(flags, recipe);
  });
  declare_fields(flags, recipe.fractal);
  flags.toggle("--no-renormalize", "Let the variance grow with the octaves instead of keeping it at 1",
               [&recipe] { recipe.fractal.renormalize = false; });
}

std::vector<std::string> noise_flags() {
  std::vector<std::string> names{"--noise", "--size", "--no-renormalize"};
  const auto add = [&](const auto& field, const auto&) { names.push_back(flag_of(field.name)); };
  for_each_flag_of_noises(add);
  for_each_flag(FractalOptions{}, add);
  return names;
}

void declare_generator_flag(FlagSet& flags, NoiseRecipe& recipe, const int& dims) {
  flags.choice(
      "--generator", {"named", "auto"},
      "gabor, gabor-oriented without anisotropy: the noise that is named, or of the two the one that is "
      "cheaper at the same likeness to a Gaussian field (default named)",
      [&recipe, &dims](std::size_t index) {
        if (index == 0) return;
        if (!has_generators(recipe)) {
          throw UsageError(
              "--generator auto needs --noise gabor with weights of 1 and -1, or gabor-oriented "
              "without anisotropy");
        }
        recipe = cheapest_generator(recipe, dims);
      });
}

}  // namespace solidnoise
