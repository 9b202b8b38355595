#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace solidnoise {

// JSON as recipes use it: keys keep the order they were written in.
using Json = nlohmann::ordered_json;

// Version of the recipes' form, under the key "solidnoise" of each of them. A reader takes it and all before
// it.
inline constexpr int kRecipeVersion = 2;

// Parses a text, in which // and /* */ are comments. Throws std::invalid_argument with the line; a key given
// twice is refused too, and more keys in one object, or more objects, than any recipe has.
Json parse_json(std::string_view text);

// A message about a part of the text that begins with its path, as those of readers do
// ("layers[1].warp.amount is -1; ..."), with the line: "line 12: layers[1].warp.amount is -1; ...". The line
// is that of the innermost thing around it where the path does not exist; the message stays as it is where
// not even that does.
std::string with_line(std::string_view text, const std::string& message);

// What messages show of a value or a key: in JSON's form, control characters escaped, 80 characters at most.
std::string shown(const Json& json);

// Throws std::invalid_argument that names the key whose text is not UTF-8, as names of files may be and JSON
// cannot be.
void require_utf8(const Json& json, const std::string& path = {});

// The text of a recipe: indented, arrays of numbers in one line. Doubles are written with the fewest digits
// that read back as the same double.
std::string format_json(const Json& json);

}  // namespace solidnoise
