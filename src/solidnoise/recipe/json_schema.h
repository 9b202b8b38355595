#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "solidnoise/core/check.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// Pieces of a JSON Schema, draft 2020-12, of which field_json.h makes those of structs.
Json number_schema(const Interval& allowed);
Json integer_schema(const Interval& allowed, bool is_unsigned);
Json numbers_schema(const Interval& allowed, std::size_t count);  // an array of so many
Json words_schema(const std::vector<std::string_view>& words);
Json object_schema(Json properties);  // of these keys and no others

// Adds a sentence for people, and the unit by itself, too, for those who make controls of a schema.
void describe_schema(Json& schema, std::string_view help, std::string_view unit);

// The schema of a whole file: what every recipe begins with goes before the schema's own properties.
Json file_schema(std::string_view title, Json schema);

}  // namespace solidnoise
