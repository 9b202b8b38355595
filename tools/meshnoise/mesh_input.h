#pragma once

#include <string>

#include "solidnoise/geometry/read_mesh.h"

namespace solidnoise {

enum class Notes { print, keep_quiet };

// Reads a mesh, and prints what deserves a warning on the standard error. Throws std::runtime_error.
MeshReading read_input_mesh(const std::string& path, Notes notes);

}  // namespace solidnoise
