#include "solidnoise/volume/parameters/parameter_grids_json.h"

#include <array>
#include <string>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/field_json.h"
#include "solidnoise/volume/volume_fields.h"

namespace solidnoise {

Json JsonForm<ValueMap>::write(const ValueMap& map) {
  return {map.low, map.high, map.at_low, map.at_high};
}

void JsonForm<ValueMap>::read(JsonReader& reader, const std::string& key, ValueMap& map) {
  std::array<double, 4> numbers{map.low, map.high, map.at_low, map.at_high};
  reader.read(key, numbers);
  map = {numbers[0], numbers[1], numbers[2], numbers[3]};
}

Json JsonForm<ValueMap>::schema() {
  return numbers_schema({}, 4);
}

void add_parameter_grids(Json& recipe, const ParameterGrids& grids) {
  write_fields(grids, recipe);
}

void read_parameter_grids(JsonReader& recipe, ParameterGrids& grids) {
  read_fields(recipe, grids);
}

}  // namespace solidnoise
