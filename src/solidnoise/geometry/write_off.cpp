#include <array>
#include <string>
#include <vector>

#include "solidnoise/geometry/mesh_writers.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/vertex_attributes.h"

namespace solidnoise {

void write_off(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  NumberWriter out(stream);
  const std::vector<const VertexProperty*> normals = normal_parts(mesh);
  const std::vector<const VertexProperty*> colors = color_channels(mesh);
  const std::vector<const VertexProperty*> texture = texture_coordinates(mesh);

  if (!texture.empty()) out.text("ST");
  if (!colors.empty()) out.text("C");
  if (!normals.empty()) out.text("N");
  out.text("OFF\n");
  write_comments(out, "#", options.comments);
  out.decimal(mesh.positions.size());
  out.text(" ");
  out.decimal(mesh.face_count());
  out.text(" 0\n");

  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto put_values = [&](const std::vector<const VertexProperty*>& parts) {
      for (const VertexProperty* part : parts) {
        out.text(" ");
        out.finite_decimal(part->values[v], part->type);
      }
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) out.text(" ");
      out.decimal(mesh.positions[v][axis]);
    }
    put_values(normals);
    for (const VertexProperty* channel : colors) {
      out.text(" ");
      out.decimal(std::uint64_t{byte_color(*channel, v)});
    }
    if (colors.size() == 3) out.text(" 255");
    put_values(texture);
    out.text("\n");
  }

  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    out.decimal(mesh.face(f).size());
    for (const std::uint32_t corner : mesh.face(f)) {
      out.text(" ");
      out.decimal(std::uint64_t{corner});
    }
    out.text("\n");
  }
  out.finish();
}

}  // namespace solidnoise
