#include "solidnoise/geometry/texture_coordinates.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace solidnoise {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kNames{
    {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}};

std::vector<Vec<2>> of_vertices(const PolygonMesh& mesh) {
  for (const auto& [first, second] : kNames) {
    const VertexProperty* const u = mesh.property(first);
    const VertexProperty* const v = mesh.property(second);
    if (u == nullptr || v == nullptr) continue;
    std::vector<Vec<2>> corners;
    corners.reserve(mesh.corners.size());
    for (const std::uint32_t vertex : mesh.corners)
      corners.emplace_back(u->values[vertex], v->values[vertex]);
    return corners;
  }
  return {};
}

}  // namespace

std::vector<Vec<2>> corner_coordinates(const MeshReading& reading, const std::string& name) {
  const PolygonMesh& mesh = reading.mesh;
  std::vector<Vec<2>> corners = reading.texture.empty() ? of_vertices(mesh) : reading.texture;
  if (corners.empty()) {
    throw std::runtime_error(
        fmt::format("{}: it has no texture coordinates: neither vt of an .obj, nor vertices' numbers s and "
                    "t, u and v, or "
                    "texture_u and texture_v",
                    name));
  }
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    for (std::size_t corner = mesh.face_starts[face]; corner < mesh.face_starts[face + 1]; ++corner) {
      if (std::isfinite(corners[corner].x) && std::isfinite(corners[corner].y)) continue;
      throw std::runtime_error(
          fmt::format("{}: face {} lacks texture coordinates, or they are not finite", name, face));
    }
  }
  return corners;
}

}  // namespace solidnoise
