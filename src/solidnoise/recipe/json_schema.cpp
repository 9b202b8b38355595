#include "solidnoise/recipe/json_schema.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace solidnoise {
namespace {

// Whole numbers stay whole in the text.
Json limit(double value, bool whole) {
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

void add_limits(Json& schema, const Interval& allowed, bool whole = false) {
  if (std::isfinite(allowed.least)) {
    schema[allowed.without_least ? "exclusiveMinimum" : "minimum"] = limit(allowed.least, whole);
  }
  if (std::isfinite(allowed.most)) schema["maximum"] = limit(allowed.most, whole);
}

}  // namespace

Json number_schema(const Interval& allowed) {
  Json schema{{"type", "number"}};
  add_limits(schema, allowed);
  return schema;
}

Json integer_schema(const Interval& allowed, bool is_unsigned) {
  Json schema{{"type", "integer"}};
  if (is_unsigned) {
    schema["minimum"] = 0;
    schema["maximum"] = std::numeric_limits<std::uint64_t>::max();
  }
  add_limits(schema, allowed, true);
  return schema;
}

Json numbers_schema(const Interval& allowed, std::size_t count) {
  return {{"type", "array"}, {"items", number_schema(allowed)}, {"minItems", count}, {"maxItems", count}};
}

Json words_schema(const std::vector<std::string_view>& words) {
  return {{"enum", words}};
}

Json object_schema(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

void describe_schema(Json& schema, std::string_view help, std::string_view unit) {
  if (help.empty()) return;
  schema["description"] = std::string(help) + (unit.empty() ? "" : " (" + std::string(unit) + ")");
  if (!unit.empty()) schema["unit"] = unit;
}

Json file_schema(std::string_view title, Json schema) {
  Json file{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  Json properties{{"solidnoise", {{"enum", {1, kRecipeVersion}}}}, {"algorithm", {{"type", "integer"}}}};
  properties["$schema"] = {{"type", "string"}};
  properties.update(schema["properties"]);
  schema["properties"] = std::move(properties);
  schema["required"] = {"solidnoise"};
  file.update(schema);
  return file;
}

}  // namespace solidnoise
