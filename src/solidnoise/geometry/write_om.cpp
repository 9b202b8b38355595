#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_writers.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/om_format.h"
#include "solidnoise/geometry/vertex_attributes.h"

namespace solidnoise {
namespace {

void put_chunk(NumberWriter& out, const OmChunk& chunk) {
  out.bytes(chunk.pack(), ScalarType::uint16);
}

void write_header(NumberWriter& out, const PolygonMesh& mesh, bool triangles) {
  out.text(triangles ? "OMT" : "OMP");
  out.bytes(om_version(1, 2), ScalarType::uint8);
  out.bytes(static_cast<double>(mesh.positions.size()), ScalarType::uint32);
  out.bytes(static_cast<double>(mesh.face_count()), ScalarType::uint32);
  out.bytes(0, ScalarType::uint32);  // edges: they follow from the faces
}

void write_faces(NumberWriter& out, const PolygonMesh& mesh, bool triangles) {
  put_chunk(out, {.entity = OmChunk::face, .type = OmChunk::topology, .bits = 2});
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() > std::numeric_limits<std::uint16_t>::max()) {
      throw std::invalid_argument(fmt::format("face {} has {} vertices; OM holds 65535", f, face.size()));
    }
    if (!triangles) out.bytes(static_cast<double>(face.size()), ScalarType::uint16);
    for (const std::uint32_t corner : face) out.bytes(corner, ScalarType::uint32);
  }
}

}  // namespace

void write_om(std::ostream& stream, const PolygonMesh& mesh) {
  NumberWriter out(stream);
  bool triangles = true;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) triangles = triangles && mesh.face(f).size() == 3;
  write_header(out, mesh, triangles);

  const ScalarType position_type = stored_position_type(mesh);
  const unsigned bits = position_type == ScalarType::float64 ? 1 : 0;
  put_chunk(out,
            {.type = OmChunk::position, .is_signed = true, .is_float = true, .dimensions = 3, .bits = bits});
  for (const Vec<3>& position : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) out.bytes(position[axis], position_type);
  }
  if (const auto normals = normal_parts(mesh); !normals.empty()) {
    put_chunk(out, {.type = OmChunk::normal, .is_signed = true, .is_float = true, .dimensions = 3});
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      for (const VertexProperty* part : normals) out.bytes(part->values[v], ScalarType::float32);
    }
  }
  if (auto colors = color_channels(mesh); !colors.empty()) {
    colors.resize(3);  // the format has no alpha
    put_chunk(out, {.type = OmChunk::color, .dimensions = 3});
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      for (const VertexProperty* channel : colors) out.bytes(byte_color(*channel, v), ScalarType::uint8);
    }
  }
  write_faces(out, mesh, triangles);
  out.finish();
}

}  // namespace solidnoise
