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
  std::vector<std::string> comments = {};  // PLY, OBJ, OFF: at the head, a line each
  Existing existing = Existing::refuse;
  Progress* progress = nullptr;  // asked for cancellation while writing
};

// Writes a mesh by the path's extension, all or nothing, as write_output does:
//   .ply  positions of position_type, then every property by name, type and order
//   .obj  positions; red green blue, scaled to 1, after them; nx ny nz as normals of the same numbers; no
//         faces without vertices
//   .off  positions; nx ny nz; red green blue alpha in 8 bits (opaque if there is no alpha); s t
//   .om   positions of position_type; nx ny nz; red green blue in 8 bits. OpenMesh's version 1, whose faces
//         are lists of vertices, because version 2 can hold manifolds only
// Formats but PLY leave out other properties. Texts have the shortest decimals that read back as the same
// number; OBJ and OFF have 0 for values that are not finite. Values that their type cannot hold are clamped;
// integers are rounded. STL holds no shared vertices and no colours, and is not written.
//
// Throws std::runtime_error naming the path (also for an unknown extension), OutputExists, Cancelled;
// std::invalid_argument for a property whose count is not that of the vertices, or that has a name which is
// empty, has blanks, or is that of another or of a coordinate, and in OM for a face of more than 65535
// vertices.
void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh,
                const MeshWriteOptions& options = {});

// The same to a stream, which should throw on errors. STL throws std::invalid_argument.
void write_mesh(std::ostream& stream, MeshFormat format, const PolygonMesh& mesh,
                const MeshWriteOptions& options = {});

}  // namespace solidnoise
