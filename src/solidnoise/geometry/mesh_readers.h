#pragma once

#include <string>
#include <string_view>

#include "solidnoise/geometry/read_mesh.h"

namespace solidnoise {

// One reader per format, for read_mesh. `name` stands for the path in messages. Each checks every position
// and index; a mesh without vertices or faces passes.
MeshReading read_ply(std::string_view bytes, const std::string& name);
MeshReading read_obj(std::string_view bytes, const std::string& name);
MeshReading read_off(std::string_view bytes, const std::string& name);
MeshReading read_stl(std::string_view bytes, const std::string& name);
MeshReading read_om(std::string_view bytes, const std::string& name);

}  // namespace solidnoise
