#pragma once

#include <optional>
#include <string>

#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/volume/vdb/grid_file.h"

namespace solidnoise {

// {"file": "smoke.vdb", "grid": "density", "digest": "0123456789abcdef"}: the keys are added to an object,
// and read from one. The digest is left out where there is none, and so, when reading, may be the grid.
// Throws std::invalid_argument with the path in the tree: wrong type, no file.
void add_grid_file(Json& object, const GridFile& source);
void read_grid_file(JsonReader& reader, GridFile& source);

// The object under a key of its own, if there is one; unknown keys in it are refused too.
void read_grid_file(JsonReader& reader, const std::string& key, std::optional<GridFile>& source);

}  // namespace solidnoise
