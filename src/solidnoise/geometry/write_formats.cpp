#include <bit>
#include <cstdint>
#include <ios>
#include <limits>
#include <locale>
#include <ostream>
#include <stdexcept>
#include <vector>

#include <OpenMesh/Core/IO/OMFormat.hh>
#include <OpenMesh/Core/IO/writer/OFFWriter.hh>
#include <OpenMesh/Core/IO/writer/OMWriter.hh>
#include <OpenMesh/Core/IO/writer/STLWriter.hh>
#include <fmt/format.h>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/mesh_exporter.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/openmesh_session.h"
#include "solidnoise/geometry/ply_header.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/geometry/scene_values.h"

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

void write_ply_start(NumberWriter& out, const MeshWriteOptions& options) {
  out.text(fmt::format("ply\nformat {} 1.0\n", encoding_name(options.ply)));
  write_comments(out, "comment", options.comments);
}

void write_ply_vertex_header(NumberWriter& out, const PolygonMesh& mesh) {
  out.text(fmt::format("element vertex {}\n", mesh.positions.size()));
  for (const char axis : {'x', 'y', 'z'}) {
    out.text(fmt::format("property {} {}\n", ply_type_name(stored_position_type(mesh)), axis));
  }
  for (const VertexProperty& property : mesh.properties) {
    out.text(fmt::format("property {} {}\n", ply_type_name(property.type), property.name));
  }
}

void write_ply_vertices(NumberWriter& out, const PolygonMesh& mesh, PlyEncoding encoding) {
  RowWriter row(out, encoding);
  const ScalarType position_type = stored_position_type(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) row.put(mesh.positions[v][axis], position_type);
    for (const VertexProperty& property : mesh.properties) row.put(property.values[v], property.type);
    row.end();
  }
}

void write_ply(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  const bool big = options.ply == PlyEncoding::binary_big_endian;
  NumberWriter out(stream, big ? std::endian::big : std::endian::little);
  const CornerTypes types = corner_types(mesh);
  write_ply_start(out, options);
  write_ply_vertex_header(out, mesh);
  out.text(fmt::format("element face {}\nproperty list {} {} vertex_indices\nend_header\n", mesh.face_count(),
                       ply_type_name(types.count), ply_type_name(types.index)));
  write_ply_vertices(out, mesh, options.ply);
  RowWriter row(out, options.ply);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    row.put(static_cast<double>(face.size()), types.count);
    for (const std::uint32_t corner : face) row.put(corner, types.index);
    row.end();
  }
  out.finish();
}

void write_obj_vertex(NumberWriter& out, const PolygonMesh& mesh,
                      std::span<const VertexProperty* const> colors, std::size_t vertex) {
  out.text("v");
  for (int axis = 0; axis < 3; ++axis) {
    out.text(" ");
    out.decimal(mesh.positions[vertex][axis]);
  }
  for (std::size_t c = 0; c < colors.size() && c < 3; ++c) {
    out.text(" ");
    out.finite_decimal(unit_color(*colors[c], vertex), ScalarType::float32);
  }
  out.text("\n");
}

void write_obj_normal(NumberWriter& out, std::span<const VertexProperty* const> parts, std::size_t normal) {
  out.text("vn");
  for (const VertexProperty* part : parts) {
    out.text(" ");
    out.finite_decimal(part->values[normal], part->type);
  }
  out.text("\n");
}

void write_obj(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  NumberWriter out(stream);
  write_comments(out, "#", options.comments);

  const std::vector<const VertexProperty*> colors = color_channels(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) write_obj_vertex(out, mesh, colors, v);
  const std::vector<const VertexProperty*> normals = normal_parts(mesh);
  for (std::size_t v = 0; v < mesh.positions.size() && !normals.empty(); ++v)
    write_obj_normal(out, normals, v);

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

namespace {

using OpenMesh::IO::Options;

void write_by_openmesh(std::ostream& stream, const OpenMesh::IO::BaseWriter& writer, MeshExporter& exporter,
                       const Options& options) {
  std::ios before(stream.rdbuf());
  before.copyfmt(stream);
  stream.imbue(std::locale::classic());
  {
    const OpenMeshSession session;
    writer.write(stream, exporter, options, std::numeric_limits<float>::max_digits10);
  }
  stream.copyfmt(before);
}

constexpr char kOffAndStl[] = "OFF and STL";  // whose positions OpenMesh writes as floats only

}  // namespace

// Comments come last: at the head OpenMesh's reader would take them for numbers.
void write_off(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  require_float_positions(mesh, kOffAndStl);
  MeshExporter exporter(mesh);
  Options wanted = exporter.options();
  if (wanted.vertex_has_color()) wanted += Options::ColorAlpha;
  write_by_openmesh(stream, OpenMesh::IO::OFFWriter(), exporter, wanted);
  NumberWriter out(stream);
  write_comments(out, "#", options.comments);
  out.finish();
}

void write_stl(std::ostream& stream, const PolygonMesh& mesh) {
  require_float_positions(mesh, kOffAndStl);
  PolygonMesh triangles;
  triangles.positions = mesh.positions;
  for (const Triangle& triangle : triangulate(mesh)) triangles.add_face(triangle);
  MeshExporter exporter(triangles);
  write_by_openmesh(stream, OpenMesh::IO::STLWriter(), exporter, Options::Binary);
}

void write_om(std::ostream& stream, const PolygonMesh& mesh) {
  MeshExporter exporter(mesh);
  exporter.add_connectivity();
  exporter.add_properties();
  // OpenMesh chooses the size of its integers by the edges alone.
  const auto bytes = std::size_t{1} << OpenMesh::IO::OMFormat::needed_bits(4 * exporter.n_edges());
  if (mesh.positions.size() > std::size_t{1} << (8 * bytes - 1)) {
    throw std::invalid_argument(fmt::format("there are {} vertices but {} edges; OM gives them {} bits",
                                            mesh.positions.size(), exporter.n_edges(), 8 * bytes));
  }
  Options wanted = exporter.options();
  wanted -= Options::VertexTexCoord;
  write_by_openmesh(stream, OpenMesh::IO::OMWriter(), exporter, wanted);
}

}  // namespace solidnoise
