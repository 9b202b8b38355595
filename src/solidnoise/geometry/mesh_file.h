#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// The files of meshes: Stanford PLY, Wavefront OBJ, Geomview OFF, stereolithography STL and OpenMesh's OM;
// and those of scenes: Khronos' glTF as .glb and as .gltf, which is read only, and Universal Scene
// Description as .usda, which is written only.
enum class MeshFormat { ply, obj, off, stl, om, glb, gltf, usda };

// The format that the path's extension names, in any case. Throws std::runtime_error naming the path if it
// names none.
MeshFormat mesh_format(const std::filesystem::path& path);

// Whether mesh_format would name one.
bool is_mesh_path(const std::filesystem::path& path);

// How a PLY file stores what follows its header.
enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

struct MeshReading {
  PolygonMesh mesh{};
  std::vector<std::string> comments{};  // PLY: comment and obj_info lines; OBJ: those before the first
                                        // vertex; OFF: those and all that have a line of their own; GLB,
                                        // GLTF: asset.extras.comments
  std::vector<std::string> notes{};  // what the file has and the mesh has not, in plain words, one line each
  // OBJ: where the faces' corners are in textures, face after face, v upwards; not finite where one has no
  // such place. Empty if none has.
  std::vector<Vec<2>> texture{};
  std::vector<std::string> files{};  // GLB, GLTF: the names of those that it refers to, in its folder
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
//   .glb, .gltf  glTF 2, with what buffers it has in files beside it: the triangles and points of all its
//         meshes as one, each where the first node that has it puts it (skinned ones as they are); texture
//         coordinates as properties s t. No sparse or compressed ones
// PLY and OBJ are read by ourselves: OpenMesh's readers round colours to 8 bits and positions to floats,
// copy vertices, drop faces without a word, and some damaged files crash them. OFF, STL and OM are checked
// first, and then read by OpenMesh, and so are GLB and GLTF, by tinygltf.
//
// The vertices and faces are those of the file, in its order. Positions are kept in double precision;
// PolygonMesh::position_type says what the file needs. Numbers are read as in the "C" locale always.
//
// Throws std::runtime_error in one line that names the path, the vertex or face, counted as the file counts
// (from 1 in OBJ, from 0 in the others), and the line where the format has lines: what cannot be read, ends
// early, promises more than the file can hold, is no number, a position that is not finite, a face of
// vertices that are not there, a mesh without vertices or faces, an unknown extension. "-" is a .ply on the
// standard input.
MeshReading read_mesh(const std::filesystem::path& path);

// The same from a file's bytes; `name` stands for the path in messages.
MeshReading read_mesh(std::string_view bytes, MeshFormat format, const std::string& name);

struct MeshWriteOptions {
  PlyEncoding ply = PlyEncoding::binary_little_endian;
  std::vector<std::string> comments = {};  // PLY, OBJ: at the head, OFF: at the end; a line each
  UpAxis up = UpAxis::y;                   // GLB, USDA: which way is up in the mesh's positions
  Existing existing = Existing::refuse;
  Progress* progress = nullptr;  // asked for cancellation while writing
  OutputGroup* group = nullptr;  // with which the file appears
};

// Writes a mesh by the path's extension, all or nothing, as write_output does:
//   .ply  positions of position_type, then every property by name, type and order
//   .obj  positions; red green blue, scaled to 1, after them; nx ny nz as normals of the same numbers; no
//         faces without vertices
//   .off  positions as float32; nx ny nz; red green blue alpha in 8 bits (opaque if there is no alpha); s t
//   .stl  the faces, cut into triangles, in single precision; binary
//   .om   positions of position_type; nx ny nz; red green blue in 8 bits; all others by name and type.
//         OpenMesh's version 2.2
//   .glb  glTF 2: triangles, positions as float32, turned where z is up; colours in linear light, 16 bits;
//         nx ny nz, or smooth normals, of length 1; s t; all others as float32, with a _ before the name in
//         capitals. Comments are asset.extras.comments
//   .usda faces, positions as float32; metres, the up axis; primvars:displayColor in linear light, and one
//         of each other number, as float32. Comments are customLayerData
// Formats but these two, PLY and OM leave out other properties. PLY and OBJ, which are ours, have the
// shortest decimals that read back as the same number; OFF, which OpenMesh writes as STL and OM, has nine
// digits, and its comments at the end. Texts have 0 for values that are not finite, but PLY, and so have the
// normals of OM, and .glb. Values that their type cannot hold are clamped; integers are rounded.
//
// Throws std::runtime_error naming the path (also for an unknown extension), OutputExists, Cancelled;
// std::invalid_argument for a property whose count is not that of the vertices, or that has a name which is
// empty, has blanks, or is that of another or of a coordinate; in OFF, STL, GLB and USDA for a position
// beyond float32; in the last two for names of properties that are one in the file, and a .glb of more than 4
// GiB; in OM for a face without vertices, and for so few edges that its integers cannot number the vertices.
void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh,
                const MeshWriteOptions& options = {});

// Writes to a stream, which should throw on errors.
void write_mesh(std::ostream& stream, MeshFormat format, const PolygonMesh& mesh,
                const MeshWriteOptions& options = {});

}  // namespace solidnoise
