#include "solidnoise/mesh/displace.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {

void displace(PolygonMesh& mesh, std::span<const Vec<3>> normals, std::span<const float> amounts) {
  if (amounts.size() != mesh.positions.size()) {
    throw std::invalid_argument(
        fmt::format("there are {} displacements for {} vertices", amounts.size(), mesh.positions.size()));
  }
  if (normals.size() != mesh.positions.size()) {
    throw std::invalid_argument(
        fmt::format("there are {} normals for {} vertices", normals.size(), mesh.positions.size()));
  }
  const SurfaceMesh surface(mesh);
  std::vector<double> sums(surface.point_count());
  std::vector<double> counts(surface.point_count());
  for (std::size_t v = 0; v < amounts.size(); ++v) {
    if (!std::isfinite(amounts[v])) {
      throw std::invalid_argument(fmt::format("the displacement of vertex {} is not finite", v));
    }
    sums[surface.point_of(v)] += static_cast<double>(amounts[v]);
    counts[surface.point_of(v)] += 1.0;
  }
  for (std::size_t v = 0; v < amounts.size(); ++v) {
    const std::uint32_t p = surface.point_of(v);
    mesh.positions[v] += sums[p] / counts[p] * normals[v];
  }
  if (!normal_parts(mesh).empty()) set_normals(mesh);
}

void set_normals(PolygonMesh& mesh) {
  const SurfaceMesh surface(mesh);
  for (std::size_t axis = 0; axis < kNormalNames.size(); ++axis) {
    const VertexProperty* const old = mesh.property(kNormalNames[axis]);
    VertexProperty part{
        std::string(kNormalNames[axis]), old == nullptr ? ScalarType::float32 : old->type, {}};
    part.values.resize(mesh.positions.size());
    for (std::size_t v = 0; v < part.values.size(); ++v) {
      part.values[v] = surface.normals()[surface.point_of(v)][static_cast<int>(axis)];
    }
    mesh.set_property(std::move(part));
  }
}

}  // namespace solidnoise
