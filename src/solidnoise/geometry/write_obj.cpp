#include <array>
#include <vector>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

void write_obj(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  NumberWriter out(stream);
  write_comments(out, "#", options.comments);

  const std::vector<const VertexProperty*> colors = color_channels(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    out.text("v");
    for (int axis = 0; axis < 3; ++axis) {
      out.text(" ");
      out.decimal(mesh.positions[v][axis]);
    }
    for (std::size_t c = 0; c < colors.size() && c < 3; ++c) {
      out.text(" ");
      out.finite_decimal(unit_color(*colors[c], v), ScalarType::float32);
    }
    out.text("\n");
  }

  const std::vector<const VertexProperty*> normals = normal_parts(mesh);
  for (std::size_t v = 0; v < mesh.positions.size() && !normals.empty(); ++v) {
    out.text("vn");
    for (const VertexProperty* part : normals) {
      out.text(" ");
      out.finite_decimal(part->values[v], part->type);
    }
    out.text("\n");
  }

  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).empty()) continue;
    out.text("f");
    for (const std::uint32_t corner : mesh.face(f)) {
      const std::uint64_t number = std::uint64_t{corner} + 1;
      out.text(" ");
      out.decimal(number);
      if (normals.empty()) continue;
      out.text("//");
      out.decimal(number);
    }
    out.text("\n");
  }
  out.finish();
}

}  // namespace solidnoise
