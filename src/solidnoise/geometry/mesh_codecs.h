#pragma once

#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/number_writer.h"

namespace solidnoise {

// One reader per format, for read_mesh. `name` stands for the path in messages. Each checks every position
// and index; a mesh without vertices or faces passes.
MeshReading read_ply(std::string_view bytes, const std::string& name);
MeshReading read_obj(std::string_view bytes, const std::string& name);
MeshReading read_off(std::string_view bytes, const std::string& name);
MeshReading read_stl(std::string_view bytes, const std::string& name);
MeshReading read_om(std::string_view bytes, const std::string& name);
MeshReading read_gltf(std::string_view bytes, MeshFormat format, const std::string& name);

// Whether a line of an .obj goes on in the next: a backslash at its end that is not in a comment.
inline bool continues_obj_line(std::string_view line) {
  return line.ends_with('\\') && line.find('#') == std::string_view::npos;
}

// One writer per format, for write_mesh, which has checked the properties.
void write_ply(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_obj(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_off(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_stl(std::ostream& stream, const PolygonMesh& mesh);
void write_om(std::ostream& stream, const PolygonMesh& mesh);
void write_glb(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_usda(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);

// A .glb or .gltf again as a .glb, for rewrite_mesh().
void rewrite_gltf(std::ostream& stream, std::string_view bytes, MeshFormat format, const std::string& name,
                  const PolygonMesh& mesh, const MeshWriteOptions& options);

// Parts of them: a PLY's head, up to its elements; what it says of vertices, and these; a line of an OBJ.
void write_ply_start(NumberWriter& out, const MeshWriteOptions& options);
void write_ply_vertex_header(NumberWriter& out, const PolygonMesh& mesh);
void write_ply_vertices(NumberWriter& out, const PolygonMesh& mesh, PlyEncoding encoding);
void write_obj_vertex(NumberWriter& out, const PolygonMesh& mesh,
                      std::span<const VertexProperty* const> colors, std::size_t vertex);
void write_obj_normal(NumberWriter& out, std::span<const VertexProperty* const> parts, std::size_t normal);

}  // namespace solidnoise
