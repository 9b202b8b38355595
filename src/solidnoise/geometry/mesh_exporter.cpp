#include "solidnoise/geometry/mesh_exporter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/vertex_attributes.h"

namespace solidnoise {
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
