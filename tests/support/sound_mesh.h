#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// What no mesh that was read may be: why it is not sound, or nothing.
inline std::string fault_of(const PolygonMesh& mesh) {
  for (const Vec<3>& p : mesh.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return "a position is not finite";
  }
  for (const VertexProperty& property : mesh.properties) {
    if (property.values.size() != mesh.positions.size())
      return "property " + property.name + " is of another size";
  }
  for (const std::uint32_t corner : mesh.corners) {
    if (corner >= mesh.positions.size()) return "a corner is no vertex";
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_starts[f] > mesh.face_starts[f + 1]) return "faces overlap";
  }
  if (mesh.face_starts.front() != 0 || mesh.face_starts.back() != mesh.corners.size())
    return "corners are left over";
  return {};
}

}  // namespace solidnoise
