#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "solidnoise/geometry/mesh_file.h"

namespace solidnoise {

// One reader per format, for read_mesh. `name` stands for the path in messages. Each checks every position
// and index; a mesh without vertices or faces passes.
MeshReading read_ply(std::string_view bytes, const std::string& name);
MeshReading read_obj(std::string_view bytes, const std::string& name);
MeshReading read_off(std::string_view bytes, const std::string& name);
MeshReading read_stl(std::string_view bytes, const std::string& name);
MeshReading read_om(std::string_view bytes, const std::string& name);

// One writer per format, for write_mesh, which has checked the properties.
void write_ply(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_obj(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_off(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_stl(std::ostream& stream, const PolygonMesh& mesh);
void write_om(std::ostream& stream, const PolygonMesh& mesh);

}  // namespace solidnoise
