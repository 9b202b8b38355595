#include "common/recipe_files.h"

#include <cerrno>
#include <cstdint>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/input_file.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kMostBytes = 16 << 20;

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  return read_file(path, kMostBytes);
}

std::string read_recipe(const std::filesystem::path& path, std::string_view text,
                        const std::function<void(const Json&)>& use) {
  try {
    const Json json = parse_json(text);
    use(json);
    const int algorithm = algorithm_of(json);
    if (algorithm == kAlgorithmVersion) return {};
    return fmt::format(
        "{}: made by version {} of the algorithms, this is version {}; the values will not be the same",
        path.string(), algorithm, kAlgorithmVersion);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), with_line(text, error.what())));
  }
}

namespace {

std::string list_presets() {
  std::string text;
  for (const Preset& preset : presets()) {
    text += fmt::format("{:<10} {}\n", preset.name,
                        parse_json(preset.json)["description"].get_ref<const std::string&>());
  }
  return text;
}

}  // namespace

void declare_recipe_flags(FlagSet& flags, const std::string& files, std::string& written,
                          const std::function<Json()>& schema) {
  flags.group("Recipes");
  flags.add({"--preset", "NAME", "Start from a recipe that comes with the program"});
  flags.add({"--recipe", "FILE", "Start from a recipe, .json, or from that of " + files});
  flags.exclude({"--preset", "--recipe"});
  flags.keep("--write-recipe", "FILE.json",
             "Write the recipe with all flags in it; - for the standard output", written);
  flags.toggle("--list-presets", "Print the presets", [] { throw TextRequested{list_presets()}; });
  flags.toggle("--schema", "Print the JSON Schema of recipes, with which editors complete them",
               [schema] { throw TextRequested{format_json(schema())}; });
}

void load_recipe(const FlagSet& flags, const std::string& standard,
                 const std::function<std::string(const std::filesystem::path&)>& text_in,
                 const std::function<void(const Json&)>& use) {
  if (const auto file = flags.value_of("--recipe")) {
    const std::filesystem::path path = *file;
    const std::string warning =
        read_recipe(path, path.extension() == ".json" ? read_text_file(path) : text_in(path), use);
    if (warning.empty() || flags.given("--quiet")) return;
    std::cerr << program_invocation_short_name << ": warning: " << warning << '\n';
    return;
  }
  const std::string name = flags.value_of("--preset").value_or(standard);
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  use(parse_json(presets()[parse_word("--preset", name, names)].json));
}

}  // namespace solidnoise
