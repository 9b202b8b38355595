#pragma once

#include <filesystem>
#include <functional>
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

}  // namespace solidnoise
