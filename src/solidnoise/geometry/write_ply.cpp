#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/ply_header.h"

namespace solidnoise {
namespace {

std::string_view encoding_name(PlyEncoding encoding) {
  switch (encoding) {
    case PlyEncoding::ascii:
      return "ascii";
    case PlyEncoding::binary_little_endian:
      return "binary_little_endian";
    case PlyEncoding::binary_big_endian:
      return "binary_big_endian";
  }
  return {};
}

// The types that a mesh's lists of corners need; the usual ones where they do.
struct CornerTypes {
  ScalarType count = ScalarType::uint8;
  ScalarType index = ScalarType::int32;
};

CornerTypes corner_types(const PolygonMesh& mesh) {
  CornerTypes types;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).size() > std::numeric_limits<std::uint8_t>::max()) types.count = ScalarType::int32;
  }
  if (mesh.positions.size() > std::numeric_limits<std::int32_t>::max()) types.index = ScalarType::uint32;
  return types;
}

void write_header(NumberWriter& out, const PolygonMesh& mesh, const MeshWriteOptions& options,
                  const CornerTypes& types) {
  out.text(fmt::format("ply\nformat {} 1.0\n", encoding_name(options.ply)));
  write_comments(out, "comment", options.comments);
  out.text(fmt::format("element vertex {}\n", mesh.positions.size()));
  for (const char axis : {'x', 'y', 'z'}) {
    out.text(fmt::format("property {} {}\n", ply_type_name(stored_position_type(mesh)), axis));
  }
  for (const VertexProperty& property : mesh.properties) {
    out.text(fmt::format("property {} {}\n", ply_type_name(property.type), property.name));
  }
  out.text(fmt::format("element face {}\nproperty list {} {} vertex_indices\nend_header\n", mesh.face_count(),
                       ply_type_name(types.count), ply_type_name(types.index)));
}

// Puts the values of a row one after the other, and ends it.
class RowWriter {
 public:
  RowWriter(NumberWriter& out, PlyEncoding encoding) : out_(out), is_text_(encoding == PlyEncoding::ascii) {}

  void put(double value, ScalarType type) {
    if (!is_text_) return out_.bytes(value, type);
    if (!is_first_) out_.text(" ");
    is_first_ = false;
    out_.decimal(value, type);
  }

  void end() {
    if (is_text_) out_.text("\n");
    is_first_ = true;
  }

 private:
  NumberWriter& out_;
  bool is_text_;
  bool is_first_ = true;
};

}  // namespace

void write_ply(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  const bool big = options.ply == PlyEncoding::binary_big_endian;
  NumberWriter out(stream, big ? std::endian::big : std::endian::little);
  const CornerTypes types = corner_types(mesh);
  write_header(out, mesh, options, types);

  RowWriter row(out, options.ply);
  const ScalarType position_type = stored_position_type(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) row.put(mesh.positions[v][axis], position_type);
    for (const VertexProperty& property : mesh.properties) row.put(property.values[v], property.type);
    row.end();
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    row.put(static_cast<double>(face.size()), types.count);
    for (const std::uint32_t corner : face) row.put(corner, types.index);
    row.end();
  }
  out.finish();
}

}  // namespace solidnoise
