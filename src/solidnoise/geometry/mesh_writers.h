#pragma once

#include <iosfwd>

#include "solidnoise/geometry/write_mesh.h"

namespace solidnoise {

// One writer per format, for write_mesh, which has checked the properties.
void write_ply(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_obj(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_off(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options);
void write_stl(std::ostream& stream, const PolygonMesh& mesh);
void write_om(std::ostream& stream, const PolygonMesh& mesh);

}  // namespace solidnoise
