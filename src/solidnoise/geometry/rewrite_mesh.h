#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "solidnoise/geometry/mesh_file.h"

namespace solidnoise {

// Writes a file again with the vertices of a mesh that was read from it, and all else as it stands there: of
// an .obj every line but those of vertices, normals that belong to vertices, and
// comments before the first vertex; of a .ply, in its own encoding, all elements but the vertices, lists of
// which are left out; of a .gltf or .glb, as a .glb, all but what it has of the colours (COLOR_0) and numbers
// of the mesh: positions, nodes, materials, animations, extensions stay, and the names of files beside it.
// The mesh must have as many vertices; its faces are not looked at. `bytes` are the file's, `name` stands for
// its path in messages.
//
// Throws std::invalid_argument for another number of vertices, and for formats but these;
// std::runtime_error as read_mesh() does.
void rewrite_mesh(std::ostream& stream, std::string_view bytes, MeshFormat format, const std::string& name,
                  const PolygonMesh& mesh, const MeshWriteOptions& options);

// Whether a note of read_mesh()'s is of something that rewrite_mesh() keeps.
bool is_kept(const std::string& note);

}  // namespace solidnoise
