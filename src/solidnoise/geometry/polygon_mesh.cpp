#include "solidnoise/geometry/polygon_mesh.h"

#include <algorithm>
#include <utility>

namespace solidnoise {

void PolygonMesh::add_face(std::span<const std::uint32_t> vertices) {
  corners.insert(corners.end(), vertices.begin(), vertices.end());
  face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
}

const VertexProperty* PolygonMesh::property(std::string_view name) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const VertexProperty& property) { return property.name == name; });
  return found == properties.end() ? nullptr : &*found;
}

void PolygonMesh::set_property(VertexProperty property) {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const VertexProperty& other) { return other.name == property.name; });
  if (found == properties.end()) {
    properties.push_back(std::move(property));
  } else {
    *found = std::move(property);
  }
}

std::vector<Triangle> triangulate(const PolygonMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.corners.size());
  for (std::size_t index = 0; index < mesh.face_count(); ++index) {
    const auto face = mesh.face(index);
    for (std::size_t i = 2; i < face.size(); ++i) triangles.push_back({face[0], face[i - 1], face[i]});
  }
  return triangles;
}

}  // namespace solidnoise
