#include "solidnoise/volume/vdb/grid_file_json.h"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace solidnoise {

void add_grid_file(Json& object, const GridFile& source) {
  object["file"] = source.file;
  object["grid"] = source.grid;
  if (!source.digest.empty()) object["digest"] = source.digest;
}

void read_grid_file(JsonReader& reader, GridFile& source) {
  reader.read("file", source.file);
  reader.read("grid", source.grid);
  reader.read("digest", source.digest);
  if (source.file.empty()) {
    throw std::invalid_argument(fmt::format("{} is empty; it must be a .vdb", reader.path_of("file")));
  }
}

void read_grid_file(JsonReader& reader, const std::string& key, std::optional<GridFile>& source) {
  auto object = reader.object(key);
  if (!object) return;
  read_grid_file(*object, source.emplace());
  object->finish();
}

}  // namespace solidnoise
