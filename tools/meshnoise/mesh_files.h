#pragma once

#include <span>
#include <string>
#include <type_traits>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/geometry/read_points.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

enum class Notes { print, keep_quiet };

// Reads a mesh, and prints what deserves a warning on the standard error. Throws std::runtime_error.
MeshReading read_input_mesh(const std::string& path, Notes notes, Faces faces = Faces::required);

// Whether an output of this name can keep what an input has beside its mesh (rewrite_mesh), if vertices and
// faces stay.
bool keeps_the_rest(const std::string& in, const std::string& out);

// Whether an input is a scene, whose nodes say where its vertices are: then they cannot be moved.
bool has_scene(const std::string& in);

// Whether there is something to keep.
bool has_rest(const MeshReading& reading);

// Refuses an output that would have the names of files which are not beside it: throws std::runtime_error.
void require_files_beside(const std::string& in, const std::string& out, const MeshReading& reading);

// Says what is lost where it is not kept: beside the mesh, and numbers of vertices that `out` does not hold.
void print_dropped(const std::string& path, const MeshReading& reading);
void print_dropped_numbers(const std::string& path, const PolygonMesh& mesh, const std::string& out);

// What a file is to show: an .stl has no colours.
enum class Shows { colors, shape };

// Refuses a name of --out before any work: throws UsageError if no mesh that shows this can have it, or if it
// is
// "-" and the standard output is a terminal.
void require_mesh_name(const std::string& out, Shows shows);

// Whether the file of this name holds all numbers of the vertices: all but .obj, .off and
// .stl do, and "-" is a .ply.
bool holds_numbers(const std::string& out);

// Writes a mesh as write_mesh does; "-" is a .ply on the standard output. `source` names the file whose rest
// is to be kept; empty: none.
void write_output_mesh(const std::string& out, const PolygonMesh& mesh, const MeshWriteOptions& options,
                       const std::string& source = {});

// Refuses a preview before any work: throws UsageError if the file is no .png, or if this program was built
// without Embree.
void require_preview(const std::string& path);

// How a preview is taken.
struct MeshView {
  int size = 640;           // pixels of each side
  double turn = 0.0;        // degrees
  double elevation = 16.0;  // degrees
};

constexpr auto fields_of(std::type_identity<MeshView>) {
  return list_fields(
      field("preview_size", &MeshView::size, between(16, 8192), "pixels", "Of the preview's sides"),
      field("preview_turn", &MeshView::turn, between(-360.0, 360.0), "degrees",
            "Of the preview's camera around the mesh, to the right"),
      field("preview_elevation", &MeshView::elevation, between(-85.0, 85.0), "degrees",
            "Of the preview's camera over the horizon"));
}

// A picture of a mesh in its vertices' colours (linear light).
Image render_mesh_preview(const PolygonMesh& mesh, std::span<const Vec<3>> normals,
                          std::span<const Color> colors, UpAxis up, const MeshView& options);

}  // namespace solidnoise
