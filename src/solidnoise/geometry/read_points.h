#pragma once

#include <filesystem>

#include "solidnoise/geometry/mesh_file.h"

namespace solidnoise {

// Whether a file of points alone will do.
enum class Faces { required, optional };

// Reads a mesh, as the function of this name does that knows no points without faces.
MeshReading read_mesh(const std::filesystem::path& path, Faces faces);

}  // namespace solidnoise
