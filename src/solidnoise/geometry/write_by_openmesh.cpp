#include <cstdint>
#include <ios>
#include <limits>
#include <locale>
#include <ostream>
#include <stdexcept>

#include <OpenMesh/Core/IO/OMFormat.hh>
#include <OpenMesh/Core/IO/writer/OFFWriter.hh>
#include <OpenMesh/Core/IO/writer/OMWriter.hh>
#include <OpenMesh/Core/IO/writer/STLWriter.hh>
#include <fmt/format.h>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/mesh_exporter.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/openmesh_session.h"

namespace solidnoise {
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

// Those of a type that OpenMesh writes as floats only.
void require_float_positions(const PolygonMesh& mesh) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (const Vec<3>& p : mesh.positions) {
    if (std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest && std::abs(p.z) <= kLargest) continue;
    throw std::invalid_argument(fmt::format(
        "a vertex is at ({}, {}, {}), beyond the numbers of OFF and STL; PLY holds it", p.x, p.y, p.z));
  }
}

}  // namespace

// Comments come last: at the head OpenMesh's reader would take them for numbers.
void write_off(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  require_float_positions(mesh);
  MeshExporter exporter(mesh);
  Options wanted = exporter.options();
  if (wanted.vertex_has_color()) wanted += Options::ColorAlpha;
  write_by_openmesh(stream, OpenMesh::IO::OFFWriter(), exporter, wanted);
  NumberWriter out(stream);
  write_comments(out, "#", options.comments);
  out.finish();
}

void write_stl(std::ostream& stream, const PolygonMesh& mesh) {
  require_float_positions(mesh);
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
