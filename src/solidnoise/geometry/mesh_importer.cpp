#include "solidnoise/geometry/mesh_importer.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/geometry/scalar_type.h"

namespace solidnoise {
namespace {

// Row `vertex` of a table that grows to have it.
template <typename Row>
Row& row_of(std::vector<Row>& rows, OpenMesh::VertexHandle vertex, const Row& missing = {}) {
  const auto index = static_cast<std::size_t>(vertex.idx());
  if (index >= rows.size()) rows.resize(index + 1, missing);
  return rows[index];
}

template <std::size_t Count>
void add_columns(PolygonMesh& mesh, std::vector<std::array<double, Count>> rows,
                 const std::array<std::string_view, Count>& names) {
  if (rows.empty()) return;
  rows.resize(mesh.positions.size());
  for (std::size_t c = 0; c < Count; ++c) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const auto& row : rows) values.push_back(row[c]);
    mesh.properties.push_back(text_property(names[c], std::move(values)));
  }
}

// Formats that want an alpha with every colour have it opaque where there is none: opaque everywhere says
// nothing.
bool is_opaque(const std::vector<TextColor>& colors) {
  double opaque = 1.0;
  for (const TextColor& color : colors) {
    for (const double part : color) opaque = part > 1.0 ? 255.0 : opaque;
  }
  for (const TextColor& color : colors) {
    if (!std::isnan(color[3]) && color[3] != opaque) return false;
  }
  return true;
}

}  // namespace

PolygonMesh MeshImporter::take_mesh() {
  walk_loops();
  add_columns(mesh_, std::move(normals_), kNormalNames);
  if (!colors_.empty()) {
    colors_.resize(mesh_.positions.size(), kNoColor);
    add_text_colors(mesh_, colors_, is_opaque(colors_) ? 3 : 4);
  }
  add_columns(mesh_, std::move(texture_), kTextureNames);
  return std::move(mesh_);
}

VertexProperty MeshImporter::property(const std::string& name, ScalarType type) const {
  VertexProperty property{name, type, {}};
  visit_scalar_type(type, [&](auto number) {
    OpenMesh::VPropHandleT<decltype(number)> handle;
    if (!kernel_.get_property_handle(handle, name)) return;
    const auto& values = kernel_.property(handle).data_vector();
    property.values.assign(values.begin(), values.end());
  });
  return property;
}

OpenMesh::VertexHandle MeshImporter::add_vertex(const OpenMesh::Vec3f& point) {
  return add_position({point[0], point[1], point[2]});
}

OpenMesh::VertexHandle MeshImporter::add_vertex(const OpenMesh::Vec3d& point) {
  mesh_.position_type = ScalarType::float64;
  return add_position({point[0], point[1], point[2]});
}

OpenMesh::VertexHandle MeshImporter::add_position(const Vec<3>& position) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(position[axis])) continue;
    refuse(fmt::format("vertex {}: its {} is not finite", mesh_.positions.size(), "xyz"[axis]));
  }
  mesh_.positions.push_back(position);
  return OpenMesh::VertexHandle(static_cast<int>(mesh_.positions.size() - 1));
}

OpenMesh::FaceHandle MeshImporter::add_face(const VHandles& corners) {
  const std::size_t face = mesh_.face_count();
  std::vector<std::uint32_t> vertices;
  vertices.reserve(corners.size());
  for (const OpenMesh::VertexHandle corner : corners) vertices.push_back(checked_corner(face, corner.idx()));
  mesh_.add_face(vertices);
  return OpenMesh::FaceHandle(static_cast<int>(face));
}

OpenMesh::HalfedgeHandle MeshImporter::add_edge(OpenMesh::VertexHandle from, OpenMesh::VertexHandle to) {
  const OpenMesh::HalfedgeHandle first(static_cast<int>(halfedges_.size()));
  halfedges_.push_back({-1, to.idx()});
  halfedges_.push_back({-1, from.idx()});
  return first;
}

OpenMesh::FaceHandle MeshImporter::add_face(OpenMesh::HalfedgeHandle halfedge) {
  loops_.push_back(halfedge.idx());
  return OpenMesh::FaceHandle(static_cast<int>(loops_.size() - 1));
}

void MeshImporter::set_next(OpenMesh::HalfedgeHandle halfedge, OpenMesh::HalfedgeHandle next) {
  halfedges_.at(static_cast<std::size_t>(halfedge.idx())).next = next.idx();
}

// From each face's half-edge along the next ones until it is met again.
void MeshImporter::walk_loops() {
  std::vector<bool> used(halfedges_.size());
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0; f < loops_.size(); ++f) {
    corners.clear();
    std::int64_t current = loops_[f];
    do {
      if (current < 0 || static_cast<std::size_t>(current) >= halfedges_.size()) {
        refuse(fmt::format("face {}: it has half-edge {}, but there are {}", f, current, halfedges_.size()));
      }
      const auto index = static_cast<std::size_t>(current);
      if (used[index]) refuse(fmt::format("face {}: its half-edges are no loop of its own", f));
      used[index] = true;
      corners.push_back(checked_corner(f, halfedges_[index].vertex));
      current = halfedges_[index].next;
    } while (current != loops_[f]);
    mesh_.add_face(corners);
  }
}

void MeshImporter::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) {
  set_normal(vertex, OpenMesh::Vec3d(normal));
}

void MeshImporter::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) {
  row_of(normals_, vertex) = {normal[0], normal[1], normal[2]};
}

void MeshImporter::set_color(OpenMesh::VertexHandle vertex, const TextColor& color) {
  row_of(colors_, vertex, kNoColor) = color;
}

void MeshImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3uc& color) {
  set_color(vertex, TextColor{double(color[0]), double(color[1]), double(color[2]), kNoNumber});
}

void MeshImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4uc& color) {
  set_color(vertex, TextColor{double(color[0]), double(color[1]), double(color[2]), double(color[3])});
}

void MeshImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& color) {
  set_color(vertex, TextColor{color[0], color[1], color[2], kNoNumber});
}

void MeshImporter::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4f& color) {
  set_color(vertex, TextColor{color[0], color[1], color[2], color[3]});
}

void MeshImporter::set_texcoord(OpenMesh::VertexHandle vertex, const OpenMesh::Vec2f& place) {
  row_of(texture_, vertex) = {place[0], place[1]};
}

std::uint32_t MeshImporter::checked_corner(std::size_t face, std::int64_t corner) const {
  if (corner < 0 || static_cast<std::size_t>(corner) >= mesh_.positions.size()) {
    refuse(fmt::format("face {}: it has vertex {}, but there are {} vertices", face, corner,
                       mesh_.positions.size()));
  }
  return static_cast<std::uint32_t>(corner);
}

void MeshImporter::refuse(const std::string& what) const {
  throw std::runtime_error(fmt::format("{}: {}", name_, what));
}

}  // namespace solidnoise
