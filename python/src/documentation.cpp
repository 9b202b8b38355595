#include "documentation.h"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "json.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise::python {
namespace {

// As Python writes it.
std::string literal(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "True" : "False";
  if (value.is_null()) return "None";
  if (value.is_string()) return fmt::format("'{}'", value.get<std::string>());
  if (!value.is_array()) return value.dump();
  std::vector<std::string> items;
  for (const Json& item : value) items.push_back(literal(item));
  return fmt::format("({})", fmt::join(items, ", "));
}

std::string type_of(const Json& schema) {
  if (schema.contains("enum")) {
    std::vector<std::string> words;
    for (const Json& word : schema["enum"]) words.push_back(literal(word));
    return fmt::format("{}", fmt::join(words, ", "));
  }
  const std::string type = schema.value("type", "object");
  if (type == "number") return "float";
  if (type == "integer") return "int";
  if (type == "boolean") return "bool";
  if (type == "string") return "str";
  if (type == "array")
    return schema.contains("maxItems") ? fmt::format("{} floats", schema["maxItems"].dump()) : "list";
  return "dict";
}

// As short as it may be: "0.05", "1e+12".
std::string short_number(const Json& number) {
  return fmt::format("{:g}", number.get<double>());
}

// "above 0", "0.05 to 4"; empty for any.
std::string range_of(const Json& schema) {
  const Json& number = schema.contains("items") ? schema["items"] : schema;
  const bool has_most = number.contains("maximum") && number["maximum"].get<double>() < 1e18;
  const std::string most = has_most ? short_number(number["maximum"]) : std::string();
  if (number.contains("exclusiveMinimum")) {
    const std::string above = fmt::format("above {}", short_number(number["exclusiveMinimum"]));
    return has_most ? fmt::format("{}, at most {}", above, most) : above;
  }
  if (number.contains("minimum")) {
    const std::string least = short_number(number["minimum"]);
    return has_most ? fmt::format("{} to {}", least, most) : fmt::format("at least {}", least);
  }
  return has_most ? fmt::format("at most {}", most) : std::string();
}

}  // namespace

std::string describe_options(const Json& schema) {
  std::string text;
  for (const auto& [name, option] : schema["properties"].items()) {
    if (name == "type" || name == "$schema" || name == "solidnoise" || name == "algorithm") continue;
    text += fmt::format("{} : {}", name, type_of(option));
    const std::string range = range_of(option);
    if (!range.empty()) text += fmt::format(", {}", range);
    if (option.contains("default")) text += fmt::format(", default {}", literal(option["default"]));
    text += fmt::format("\n    {}\n", option.value("description", ""));
  }
  return text;
}

std::string signature_of_options(const Json& schema) {
  std::string text;
  for (const auto& [name, option] : schema["properties"].items()) {
    if (name == "type") continue;
    text += fmt::format(", {}", name);
    if (option.contains("default")) text += fmt::format("={}", literal(option["default"]));
  }
  return text;
}

std::string document(std::string_view signature, std::string_view text) {
  return fmt::format("{}\n--\n\n{}", signature, text);
}

void add_schema(pybind11::module_& module) {
  using namespace pybind11::literals;
  module.def(
      "schema",
      [](const std::string& kind) {
        if (kind == "volume") return object_of(volume_recipe_schema());
        if (kind == "bake") return object_of(bake_recipe_schema());
        throw std::invalid_argument(fmt::format("kind is {}; it must be one of volume, bake", kind));
      },
      "kind"_a, R"(schema(kind)
--

The JSON Schema of the recipes of make_volume(), "volume", or of bake(), "bake": a dict with each key's type, range, default, unit and
description.)");
}

}  // namespace solidnoise::python
