#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// A mesh as arrays: positions in world units, and triangles as indices of three of them.
struct TriangleMesh {
  std::vector<Vec<3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  // The box of the positions that a triangle uses. Precondition: there is a triangle.
  Box<3> bounds() const;
};

// Reads the positions and faces of a Wavefront OBJ file; everything else in it is skipped. Polygons are cut
// into fans of triangles. Throws std::runtime_error naming the path, and the line where there is one: cannot
// be read, a malformed or non-finite number, an index out of range, a face of less than three vertices, a
// path that does not end in .obj.
TriangleMesh read_obj(const std::filesystem::path& path);

// The same from a stream; `name` stands for the path in messages.
TriangleMesh read_obj(std::istream& stream, const std::string& name);

// Throws std::invalid_argument, saying which, unless the mesh has an inside: at least one triangle, finite
// positions, and every edge between exactly two triangles. Vertices at equal positions count as one.
// Triangles with two equal corners are ignored.
void require_closed(const TriangleMesh& mesh);

}  // namespace solidnoise
