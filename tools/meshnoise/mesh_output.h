#pragma once

#include <string>

#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/geometry/write_mesh.h"

namespace solidnoise {

// What a file is to show: an .stl has no colours.
enum class Shows { colors, shape };

// Refuses a name of --out before any work: throws UsageError if no mesh that shows this can have it, or if it
// is
// "-" and the standard output is a terminal.
void require_mesh_name(const std::string& out, Shows shows);

// Whether the file of this name holds all numbers of the vertices: a .ply and an .om do, and "-" is a .ply.
bool holds_numbers(const std::string& out);

// Writes a mesh as write_mesh does; "-" is a .ply on the standard output.
void write_output_mesh(const std::string& out, const PolygonMesh& mesh, const MeshWriteOptions& options);

}  // namespace solidnoise
