#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/flag_set.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/recipe_file.h"

namespace solidnoise {

// A recipe that comes with the program, from the file presets/NAME.json.
struct Preset {
  std::string_view name;
  std::string_view json;
};

// Those of this program; defined by the source that solidnoise_tool() in CMakeLists.txt makes of them.
std::span<const Preset> presets();
std::vector<std::string_view> preset_names(std::span<const Preset> among = presets());

// Declares --preset, --recipe, --write-recipe, whose value is kept in `written`, --list-presets and --schema.
// `files` says what --recipe reads beside .json.
void declare_recipe_flags(FlagSet& flags, const std::string& files, std::string& written,
                          const std::function<Json()>& schema, std::span<const Preset> among = presets());

// Where recipes of one kind are found.
struct RecipeSource {
  std::string standard;                                              // preset, without flags
  std::function<std::string(const std::filesystem::path&)> text_in;  // the recipe in a file that is no .json
  std::span<const Preset> among = presets();
};

// Gives `use` the recipe that the flags start from: that of --recipe or --preset, or the standard one.
// Warnings are printed unless --quiet is given. Throws UsageError for a preset that there is none of, and
// std::runtime_error as read_recipe does.
void load_recipe(const FlagSet& flags, const RecipeSource& from, const std::function<void(const Json&)>& use);

// The files that --recipe and --noise name; empty: none. What writes a recipe may replace that of the first.
struct RecipeInputs {
  std::string recipe;
  std::string noise;
};
RecipeInputs recipe_inputs(const FlagSet& flags);

}  // namespace solidnoise
