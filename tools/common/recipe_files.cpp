#include "common/recipe_files.h"

#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/parse_value.h"
#include "common/recipe_link.h"
#include "common/run_tool.h"
#include "solidnoise/core/extension.h"

namespace solidnoise {
namespace {

std::string list_presets(std::span<const Preset> among) {
  std::string text;
  for (const Preset& preset : among) {
    text += fmt::format("{:<10} {}\n", preset.name,
                        parse_json(preset.json)["description"].get_ref<const std::string&>());
  }
  return text;
}

}  // namespace

std::vector<std::string_view> preset_names(std::span<const Preset> among) {
  std::vector<std::string_view> names;
  for (const Preset& preset : among) names.push_back(preset.name);
  return names;
}

void declare_recipe_flags(FlagSet& flags, const std::string& files, std::string& written,
                          const std::function<Json()>& schema, std::span<const Preset> among) {
  flags.group("Recipes");
  flags.add({"--preset", "NAME", "Start from a recipe that comes with the program"}).words =
      preset_names(among);
  flags.add(
      {"--recipe", "FILE",
       "Start from a recipe, .json, - for the standard input, from a link of the studio, or from that of " +
           files});
  flags.exclude({"--preset", "--recipe"});
  flags.keep("--write-recipe", "FILE.json",
             "Write the recipe with all flags in it; - for the standard output", written);
  flags.toggle("--list-presets", "Print the presets", [among] { throw TextRequested{list_presets(among)}; });
  flags.toggle("--schema", "Print the JSON Schema of recipes, with which editors complete them",
               [schema] { throw TextRequested{format_json(schema())}; });
}

void load_recipe(const FlagSet& flags, const RecipeSource& from,
                 const std::function<void(const Json&)>& use) {
  if (const auto file = flags.value_of("--recipe")) {
    const auto linked = recipe_in_link(*file);
    const std::filesystem::path path = linked ? "the link's recipe" : *file;
    const auto text = [&] {
      if (linked) return *linked;
      if (path == "-") return read_text_file("/dev/stdin");
      return extension_of(path) == ".json" ? read_text_file(path) : from.text_in(path);
    };
    const std::string warning = read_recipe(path, text(), use);
    if (warning.empty() || flags.given("--quiet")) return;
    std::cerr << program_invocation_short_name << ": warning: " << warning << '\n';
    return;
  }
  const std::string name = flags.value_of("--preset").value_or(from.standard);
  use(parse_json(from.among[parse_word("--preset", name, preset_names(from.among))].json));
}

RecipeInputs recipe_inputs(const FlagSet& flags) {
  return {flags.value_of("--recipe").value_or(""), flags.value_of("--noise").value_or("")};
}

}  // namespace solidnoise
