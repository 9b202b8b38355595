#pragma once

#include <span>
#include <string>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

enum class Notes { print, keep_quiet };

// Reads a mesh, and prints what deserves a warning on the standard error. Throws std::runtime_error.
MeshReading read_input_mesh(const std::string& path, Notes notes);

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

// Refuses a preview before any work: throws UsageError if the file is no .png, or if this program was built
// without Embree.
void require_preview(const std::string& path);

// A picture of a mesh in its vertices' colours (linear light).
Image render_mesh_preview(const PolygonMesh& mesh, std::span<const Vec<3>> normals,
                          std::span<const Color> colors, UpAxis up);

}  // namespace solidnoise
