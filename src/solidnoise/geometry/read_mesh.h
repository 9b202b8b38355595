#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/geometry/mesh_format.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

struct MeshReading {
  PolygonMesh mesh;
  std::vector<std::string> comments;  // PLY: comment and obj_info lines; OBJ: those before the first vertex;
                                      // OFF: those and all that have a line of their own
  std::vector<std::string> notes;     // what the file has and the mesh has not, in plain words, one line each
};

// Reads a mesh by the path's extension, in any case:
//   .ply  ascii, binary of either byte order, every scalar type; all scalar vertex properties are kept, other
//         elements, properties of faces and lists of vertices are skipped; triangle strips become triangles
//   .obj  positions, faces, and colours after the positions, as properties red green blue: float32 as they
//         are found, or uint8 if they are whole numbers up to 255
//   .off  ascii, with the prefixes ST, C and N in any combination: properties nx ny nz, red green blue alpha
//         (as in OBJ), s t
//   .stl  ascii and binary, in single precision; corners of facets at equal positions become one vertex, in
//         order of first use, and facets with two corners at one are dropped and counted
//   .om   binary, up to version 2.2: positions, faces, vertex normals and colours of three bytes, numbers
//         that vertices have as properties
// PLY and OBJ are read by ourselves: OpenMesh's readers round colours to 8 bits and positions to floats,
// copy vertices, drop faces without a word, and some damaged files crash them. The other three are checked
// first, and then read by OpenMesh.
//
// The vertices and faces are those of the file, in its order. Positions are kept in double precision;
// PolygonMesh::position_type says what the file needs. Numbers are read as in the "C" locale always.
//
// Throws std::runtime_error in one line that names the path, the vertex or face, counted as the file counts
// (from 1 in OBJ, from 0 in the others), and the line where the format has lines: what cannot be read, ends
// early, promises more than the file can hold, is no number, a position that is not finite, a face of
// vertices that are not there, a mesh without vertices or faces, an unknown extension.
MeshReading read_mesh(const std::filesystem::path& path);

// The same from a file's bytes; `name` stands for the path in messages.
MeshReading read_mesh(std::string_view bytes, MeshFormat format, const std::string& name);

}  // namespace solidnoise
