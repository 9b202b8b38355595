#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "common/flag_set.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// The whole of a file, which may be a few megabytes at most. Throws std::runtime_error naming the path.
std::string read_text_file(const std::filesystem::path& path);

// Parses the text of a recipe that was found in a file and gives it to `use`. Returns what is to be said
// about it: that other values will come out of it than when it was written; empty if there is nothing. What
// `use` throws as std::invalid_argument, and errors of the JSON, become a std::runtime_error that names the
// path and the line.
std::string read_recipe(const std::filesystem::path& path, std::string_view text,
                        const std::function<void(const Json&)>& use);

// A recipe that comes with the program, from the file presets/NAME.json.
struct Preset {
  std::string_view name;
  std::string_view json;
};

// Those of this program; defined by the source that solidnoise_tool() in CMakeLists.txt makes of them.
std::span<const Preset> presets();

// Declares --preset, --recipe, --write-recipe, whose value is kept in `written`, --list-presets and --schema.
// `files` says what --recipe reads beside .json.
void declare_recipe_flags(FlagSet& flags, const std::string& files, std::string& written,
                          const std::function<Json()>& schema);

// Gives `use` the recipe that the flags start from: that of --recipe or --preset, or the preset `standard`.
// text_in(path) is the recipe in a file that is no .json. Warnings are printed unless --quiet is given.
// Throws UsageError for a preset that there is none of, and std::runtime_error as read_recipe does.
void load_recipe(const FlagSet& flags, const std::string& standard,
                 const std::function<std::string(const std::filesystem::path&)>& text_in,
                 const std::function<void(const Json&)>& use);

}  // namespace solidnoise
