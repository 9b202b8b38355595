#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "solidnoise/core/output_file.h"
#include "solidnoise/geometry/mesh_format.h"
#include "solidnoise/geometry/ply_encoding.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

struct MeshWriteOptions {
  PlyEncoding ply = PlyEncoding::binary_little_endian;
  std::vector<std::string> comments = {};  // PLY, OBJ: at the head, OFF: at the end; a line each
  Existing existing = Existing::refuse;
  Progress* progress = nullptr;  // asked for cancellation while writing
};

// Writes a mesh by the path's extension, all or nothing, as write_output does:
//   .ply  positions of position_type, then every property by name, type and order
//   .obj  positions; red green blue, scaled to 1, after them; nx ny nz as normals of the same numbers; no
//         faces without vertices
//   .off  positions as float32; nx ny nz; red green blue alpha in 8 bits (opaque if there is no alpha); s t
//   .stl  the faces, cut into triangles, in single precision; binary
//   .om   positions of position_type; nx ny nz; red green blue in 8 bits; all others by name and type.
//         OpenMesh's version 2.2
// Formats but PLY and OM leave out other properties. PLY and OBJ, which are ours, have the shortest decimals
// that read back as the same number; OFF, which OpenMesh writes as STL and OM, has nine digits, and its
// comments at the end. Texts have 0 for values that are not finite, but PLY, and so have the normals of OM.
// Values that their type cannot hold are clamped; integers are rounded.
//
// Throws std::runtime_error naming the path (also for an unknown extension), OutputExists, Cancelled;
// std::invalid_argument for a property whose count is not that of the vertices, or that has a name which is
// empty, has blanks, or is that of another or of a coordinate; in OFF and STL for a position beyond float32;
// in OM for a face without vertices, and for so few edges that its integers cannot number the vertices.
void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh,
                const MeshWriteOptions& options = {});

// The same to a stream, which should throw on errors.
void write_mesh(std::ostream& stream, MeshFormat format, const PolygonMesh& mesh,
                const MeshWriteOptions& options = {});

}  // namespace solidnoise
