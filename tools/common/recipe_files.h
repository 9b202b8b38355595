#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

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

// Throws UsageError that lists the names if there is none of this one.
const Preset& find_preset(std::string_view name);

}  // namespace solidnoise
