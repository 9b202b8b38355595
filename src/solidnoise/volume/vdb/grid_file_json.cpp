#include "solidnoise/volume/vdb/grid_file_json.h"

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/field_json.h"
#include "solidnoise/volume/volume_fields.h"

namespace solidnoise {

void add_grid_file(Json& object, const GridFile& source) {
  write_fields(source, object);
}

void read_grid_file(JsonReader& reader, GridFile& source) {
  read_fields(reader, source);
  reader.validate(source);
}

void read_grid_file(JsonReader& reader, const std::string& key, std::optional<GridFile>& source) {
  read_value(reader, key, source);
}

}  // namespace solidnoise
