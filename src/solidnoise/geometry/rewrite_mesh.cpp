#include "solidnoise/geometry/rewrite_mesh.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <ostream>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/ply_header.h"
#include "solidnoise/geometry/ply_rows.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

// A statement of an .obj: a line with its end, and those that it continues by a backslash.
std::string_view take_statement(std::string_view& rest) {
  std::size_t end = 0;
  while (end < rest.size()) {
    const std::size_t line = end;
    end = std::min(rest.find('\n', line), rest.size() - 1) + 1;
    std::string_view text = rest.substr(line, end - line);
    while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
    if (!continues_obj_line(text)) break;
  }
  const std::string_view statement = rest.substr(0, end);
  rest.remove_prefix(end);
  return statement;
}

[[noreturn]] void refuse_count(const PolygonMesh& mesh, const std::string& name) {
  throw std::invalid_argument(
      fmt::format("the mesh has {} vertices; {} has another number of them", mesh.positions.size(), name));
}

void rewrite_obj(std::ostream& stream, std::string_view rest, const std::string& name,
                 const PolygonMesh& mesh, const std::vector<std::string>& comments) {
  NumberWriter out(stream);
  write_comments(out, "#", comments);
  const auto colors = color_channels(mesh);
  const auto normals = normal_parts(mesh);
  std::size_t vertex = 0;
  std::size_t normal = 0;
  while (!rest.empty()) {
    const std::string_view statement = take_statement(rest);
    std::string_view words = statement;
    const std::string_view keyword = take_word(words);
    if (keyword == "v") {
      if (vertex == mesh.positions.size()) refuse_count(mesh, name);
      write_obj_vertex(out, mesh, colors, vertex++);
    } else if (keyword == "vn" && !normals.empty()) {
      if (normal == mesh.positions.size()) refuse_count(mesh, name);
      write_obj_normal(out, normals, normal++);
    } else if (vertex > 0 || !keyword.starts_with('#')) {
      out.text(statement);
    }
  }
  if (vertex != mesh.positions.size()) refuse_count(mesh, name);
  out.finish();
}

// How many bytes the rows of an element take at the front of `body`.
template <typename Rows>
std::size_t length_of(std::string_view body, const std::string& name, const PlyHeader& header,
                      const PlyElement& element) {
  Rows rows(body, name, header);
  const std::uint64_t before = rows.left();
  if (!element.properties.empty()) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows.begin_row(element, i);
      for (const PlyProperty& property : element.properties) {
        const double values = property.count_type ? rows.take(*property.count_type) : 1.0;
        for (double k = 0.0; k < values; ++k) rows.take(property.type);
      }
      rows.end_row();
    }
  }
  return static_cast<std::size_t>(before - rows.left());
}

void rewrite_ply(std::ostream& stream, std::string_view bytes, const std::string& name,
                 const PolygonMesh& mesh, MeshWriteOptions options) {
  const PlyHeader header = read_ply_header(bytes, name);
  options.ply = header.encoding;
  const bool big = header.encoding == PlyEncoding::binary_big_endian;
  NumberWriter out(stream, big ? std::endian::big : std::endian::little);
  write_ply_start(out, options);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      if (element.count != mesh.positions.size()) refuse_count(mesh, name);
      write_ply_vertex_header(out, mesh);
      continue;
    }
    out.text(fmt::format("element {} {}\n", element.name, element.count));
    for (const PlyProperty& property : element.properties) {
      const std::string list =
          property.count_type ? fmt::format("list {} ", ply_type_name(*property.count_type)) : std::string();
      out.text(fmt::format("property {}{} {}\n", list, ply_type_name(property.type), property.name));
    }
  }
  out.text("end_header\n");

  std::string_view body = bytes.substr(header.bytes);
  for (const PlyElement& element : header.elements) {
    const std::size_t length = header.encoding == PlyEncoding::ascii
                                   ? length_of<PlyTextRows>(body, name, header, element)
                                   : length_of<PlyBinaryRows>(body, name, header, element);
    if (element.name == "vertex") {
      write_ply_vertices(out, mesh, options.ply);
    } else {
      out.text(body.substr(0, length));
    }
    body.remove_prefix(std::min(length, body.size()));
  }
  out.finish();
}

}  // namespace

void rewrite_mesh(std::ostream& stream, std::string_view bytes, MeshFormat format, const std::string& name,
                  const PolygonMesh& mesh, const MeshWriteOptions& options) {
  if (format == MeshFormat::obj) return rewrite_obj(stream, bytes, name, mesh, options.comments);
  if (format == MeshFormat::ply) return rewrite_ply(stream, bytes, name, mesh, options);
  if (format == MeshFormat::glb || format == MeshFormat::gltf)
    return rewrite_gltf(stream, bytes, format, name, mesh, options);
  throw std::invalid_argument(
      fmt::format("{}: only .ply, .obj and glTF files are written again in part", name));
}

bool is_kept(const std::string& note) {
  return note.find("dropped") != std::string::npos && !note.starts_with("the vertices' lists");
}

}  // namespace solidnoise
