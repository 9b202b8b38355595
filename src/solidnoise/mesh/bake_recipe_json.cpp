#include "solidnoise/mesh/bake_recipe_json.h"

#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/layer_json.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/recipe/recipe_header.h"

namespace solidnoise {

// One number where it does not vary.
template <>
struct JsonForm<ParameterRange> {
  static Json write(const ParameterRange& range) {
    if (!range.varies()) return range.from;
    return {range.from, range.to};
  }
  static void read(JsonReader& reader, const std::string& key, ParameterRange& range) {
    reader.read_range(key, range.from, range.to);
  }
  static Json schema(const Interval& allowed) {
    return {{"oneOf", {number_schema(allowed), numbers_schema(allowed, 2)}}};
  }
};

template <>
struct JsonForm<Steering> {
  static Json write(const Steering& steering) {
    Json json = Json::object();
    write_fields(steering, json);
    return json;
  }
  static void read(JsonReader& reader, const std::string& key, Steering& steering) {
    auto object = reader.object(key);
    if (!object) return;
    if (object->has("source") && object->has("attribute")) {
      throw std::invalid_argument(object->path_of("source") +
                                  " and attribute contradict each other; give one of them");
    }
    read_fields(*object, steering);
    if (object->has("attribute")) steering.source = SteeringSource::attribute;
    object->finish();
    object->validate(steering);
  }
  static Json schema() {
    Json schema = schema_of<Steering>();
    schema["not"]["required"] = {"source", "attribute"};
    return schema;
  }
};

Json to_json(const BakeRecipe& recipe) {
  Json json = recipe_header();
  write_fields(recipe, json);
  return json;
}

BakeRecipe bake_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  BakeRecipe recipe;
  read_fields(reader, recipe);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

Json bake_recipe_schema() {
  Json schema = file_schema("Noise on a mesh, for meshnoise", schema_of<BakeRecipe>());
  schema["$defs"] = {{"noise", noise_recipe_schema()}, {"layer", schema_of<Layer>()}};
  return schema;
}

}  // namespace solidnoise
