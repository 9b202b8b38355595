#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/mesh_file.h"

namespace solidnoise {

// Where each corner of the mesh's faces is in textures, face after face, u to the right and v upwards: what
// the file has for corners (MeshReading::texture), else the vertices' numbers s t, u v or texture_u
// texture_v. Throws std::runtime_error naming the file if there are none, or the first face that lacks them
// or whose coordinates are not finite.
std::vector<Vec<2>> corner_coordinates(const MeshReading& reading, const std::string& name);

}  // namespace solidnoise
