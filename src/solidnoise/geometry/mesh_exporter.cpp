#include "solidnoise/geometry/mesh_exporter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/geometry/scalar_type.h"

namespace solidnoise {
namespace {

// The side of a face from one corner to the next.
struct Side {
  std::uint64_t vertices;  // of the edge: the smaller one in the upper half
  bool upward;             // from the smaller to the larger
  std::uint32_t corner;    // that it points to, in PolygonMesh::corners
};

std::vector<Side> sorted_sides(const PolygonMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(mesh.corners.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.empty())
      throw std::invalid_argument(fmt::format("face {} has no vertices; OM holds none such", f));
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint64_t from = face[k == 0 ? face.size() - 1 : k - 1];
      const std::uint64_t to = face[k];
      sides.push_back({std::min(from, to) << 32 | std::max(from, to), from < to,
                       static_cast<std::uint32_t>(mesh.face_starts[f] + k)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.vertices, a.upward, a.corner) < std::tie(b.vertices, b.upward, b.corner);
  });
  return sides;
}

}  // namespace

HalfEdges::HalfEdges(const PolygonMesh& mesh) {
  if (mesh.corners.size() > std::numeric_limits<std::int32_t>::max() / 2) {
    throw std::invalid_argument(fmt::format("faces have {} corners; OM holds 2^30", mesh.corners.size()));
  }
  if (mesh.positions.size() > std::numeric_limits<std::int32_t>::max()) {
    throw std::invalid_argument(fmt::format("there are {} vertices; OM holds 2^31", mesh.positions.size()));
  }
  // An edge for each two sides that go opposite ways, and for each that is left over.
  std::vector<std::int32_t> at_corner(mesh.corners.size());  // the half-edge that points to it
  const auto add = [&](const Side& side) {
    const std::uint32_t vertex = mesh.corners[side.corner];
    at_corner[side.corner] = static_cast<std::int32_t>(halfedges.size());
    halfedges.push_back({-1, static_cast<std::int32_t>(vertex), 0});
  };
  const auto add_open = [&](const Side& side) {
    add(side);
    const std::uint64_t other =
        (side.vertices >> 32) ^ (side.vertices & 0xffffffffu) ^ mesh.corners[side.corner];
    halfedges.push_back({-1, static_cast<std::int32_t>(other), -1});
  };
  const std::vector<Side> sides = sorted_sides(mesh);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const Side& side) { return side.vertices != first->vertices; });
    auto down = first;
    auto up = std::find_if(first, last, [](const Side& side) { return side.upward; });
    const auto middle = up;
    for (; down != middle && up != last; ++down, ++up) {
      add(*down);
      add(*up);
    }
    for (; down != middle; ++down) add_open(*down);
    for (; up != last; ++up) add_open(*up);
    first = last;
  }

  // Loops of faces, and the half-edge before each.
  std::vector<std::int32_t> previous(halfedges.size(), -1);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    of_face.push_back(at_corner[mesh.face_starts[f]]);
    for (std::uint32_t k = mesh.face_starts[f]; k < mesh.face_starts[f + 1]; ++k) {
      const bool is_last = k + 1 == mesh.face_starts[f + 1];
      const std::int32_t next = at_corner[is_last ? mesh.face_starts[f] : k + 1];
      HalfEdge& halfedge = halfedges[static_cast<std::size_t>(at_corner[k])];
      halfedge.next = next;
      halfedge.face = static_cast<std::int32_t>(f);
      previous[static_cast<std::size_t>(next)] = at_corner[k];
    }
  }
  // Loops of holes: around the vertex that a half-edge points to, from face to face, until one of no face.
  of_vertex.assign(mesh.positions.size(), -1);
  for (std::size_t h = 0; h < halfedges.size(); ++h) {
    const auto from = static_cast<std::size_t>(halfedges[h ^ 1].vertex);
    if (halfedges[h].face >= 0) {
      if (of_vertex[from] < 0) of_vertex[from] = static_cast<std::int32_t>(h);
      continue;
    }
    of_vertex[from] = static_cast<std::int32_t>(h);
    std::size_t around = h ^ 1;
    while (halfedges[around].face >= 0) around = static_cast<std::size_t>(previous[around]) ^ 1;
    halfedges[h].next = static_cast<std::int32_t>(around);
  }
}

namespace {

std::size_t index_of(OpenMesh::BaseHandle handle) {
  return static_cast<std::size_t>(handle.idx());
}

float finite_number(const VertexProperty& property, std::size_t vertex) {
  const float value = nearest_float(property.values[vertex]);
  return std::isfinite(value) ? value : 0.0f;
}

}  // namespace

MeshExporter::MeshExporter(const PolygonMesh& mesh)
    : mesh_(mesh),
      position_type_(stored_position_type(mesh)),
      is_triangle_mesh_(true),
      normals_(normal_parts(mesh)),
      colors_(color_channels(mesh)),
      texture_(texture_coordinates(mesh)),
      kernel_(mesh.positions.size()) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    is_triangle_mesh_ = is_triangle_mesh_ && mesh.face(f).size() == 3;
  }
}

void MeshExporter::add_connectivity() {
  HalfEdges made(mesh_);
  halfedges_ = std::move(made.halfedges);
  halfedge_of_face_ = std::move(made.of_face);
  halfedge_of_vertex_ = std::move(made.of_vertex);
}

// OpenMesh takes a name with a colon in second place for one of its own, and stores up to 255 letters.
void MeshExporter::add_properties() {
  constexpr std::size_t kLongestName = 255;
  for (const VertexProperty& property : mesh_.properties) {
    const std::string& name = property.name;
    if (is_shown_otherwise(property) || name.size() > kLongestName || name.find(':') == 1) continue;
    visit_scalar_type(property.type, [&](auto number) {
      using Number = decltype(number);
      OpenMesh::VPropHandleT<Number> handle;
      kernel_.add_property(handle, name);
      kernel_.property(handle).set_persistent(true);
      std::transform(property.values.begin(), property.values.end(),
                     kernel_.property(handle).data_vector().begin(), nearest_number<Number>);
    });
  }
}

// The alpha is not: OpenMesh's own format has colours of three parts.
bool MeshExporter::is_shown_otherwise(const VertexProperty& property) const {
  const auto colors_end = colors_.begin() + std::min<std::ptrdiff_t>(3, std::ssize(colors_));
  return std::find(normals_.begin(), normals_.end(), &property) != normals_.end() ||
         std::find(colors_.begin(), colors_end, &property) != colors_end;
}

OpenMesh::IO::Options MeshExporter::options() const {
  OpenMesh::IO::Options options;
  if (has_vertex_normals()) options += OpenMesh::IO::Options::VertexNormal;
  if (has_vertex_colors()) options += OpenMesh::IO::Options::VertexColor;
  if (has_vertex_texcoords()) options += OpenMesh::IO::Options::VertexTexCoord;
  return options;
}

OpenMesh::Vec3f MeshExporter::point(OpenMesh::VertexHandle vertex) const {
  const Vec<3>& p = mesh_.positions[index_of(vertex)];
  return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

OpenMesh::Vec3d MeshExporter::pointd(OpenMesh::VertexHandle vertex) const {
  const Vec<3>& p = mesh_.positions[index_of(vertex)];
  return {p.x, p.y, p.z};
}

OpenMesh::Vec3f MeshExporter::normal(OpenMesh::VertexHandle vertex) const {
  const std::size_t v = index_of(vertex);
  return {finite_number(*normals_[0], v), finite_number(*normals_[1], v), finite_number(*normals_[2], v)};
}

OpenMesh::Vec3uc MeshExporter::color(OpenMesh::VertexHandle vertex) const {
  const std::size_t v = index_of(vertex);
  return {byte_color(*colors_[0], v), byte_color(*colors_[1], v), byte_color(*colors_[2], v)};
}

OpenMesh::Vec4uc MeshExporter::colorA(OpenMesh::VertexHandle vertex) const {
  constexpr std::uint8_t kOpaque = 255;
  const OpenMesh::Vec3uc rgb = color(vertex);
  return {rgb[0], rgb[1], rgb[2], colors_.size() > 3 ? byte_color(*colors_[3], index_of(vertex)) : kOpaque};
}

OpenMesh::Vec2f MeshExporter::texcoord(OpenMesh::VertexHandle vertex) const {
  const std::size_t v = index_of(vertex);
  return {finite_number(*texture_[0], v), finite_number(*texture_[1], v)};
}

unsigned int MeshExporter::get_vhandles(OpenMesh::FaceHandle face,
                                        std::vector<OpenMesh::VertexHandle>& corners) const {
  corners.clear();
  for (const std::uint32_t corner : mesh_.face(index_of(face)))
    corners.emplace_back(static_cast<int>(corner));
  return static_cast<unsigned int>(corners.size());
}

int MeshExporter::get_halfedge_id(OpenMesh::VertexHandle vertex) {
  return halfedge_of_vertex_[index_of(vertex)];
}

int MeshExporter::get_halfedge_id(OpenMesh::FaceHandle face) {
  return halfedge_of_face_[index_of(face)];
}

int MeshExporter::get_next_halfedge_id(OpenMesh::HalfedgeHandle halfedge) {
  return halfedges_[index_of(halfedge)].next;
}

int MeshExporter::get_to_vertex_id(OpenMesh::HalfedgeHandle halfedge) {
  return halfedges_[index_of(halfedge)].vertex;
}

int MeshExporter::get_face_id(OpenMesh::HalfedgeHandle halfedge) {
  return halfedges_[index_of(halfedge)].face;
}

}  // namespace solidnoise
