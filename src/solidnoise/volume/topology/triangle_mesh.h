#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// A mesh as arrays: positions in world units, and triangles as indices of three of them.
struct TriangleMesh {
  std::vector<Vec<3>> positions;
  std::vector<Triangle> triangles;

  // The box of the positions that a triangle uses. Precondition: there is a triangle.
  Box<3> bounds() const;
};

// Throws std::invalid_argument, saying which, unless the mesh has an inside: at least one triangle, finite
// positions, and every edge between exactly two triangles. Vertices at equal positions count as one.
// Triangles with two equal corners are ignored.
void require_closed(const TriangleMesh& mesh);

// The mesh of a file that has an inside. Throws std::runtime_error that names the file.
TriangleMesh read_closed_mesh(const std::string& file);

}  // namespace solidnoise
