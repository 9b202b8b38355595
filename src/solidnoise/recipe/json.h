#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace solidnoise {

// JSON as recipes use it: keys keep the order they were written in.
using Json = nlohmann::ordered_json;

// Version of the recipes' form, under the key "solidnoise" of each of them. A reader refuses any other.
inline constexpr int kRecipeVersion = 1;

// Parses a text. Throws std::invalid_argument with line and column; a key given twice is refused too.
Json parse_json(std::string_view text);

// The text of a recipe: indented, arrays of numbers in one line. Doubles are written with the fewest digits
// that read back as the same double.
std::string format_json(const Json& json);

}  // namespace solidnoise
