#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "solidnoise/geometry/mesh_file.h"

namespace solidnoise {

// The corners of a face, to be compared.
inline std::vector<std::uint32_t> corners_of(const PolygonMesh& mesh, std::size_t face) {
  const auto corners = mesh.face(face);
  return {corners.begin(), corners.end()};
}

// A file as write_mesh makes it.
inline std::string written(const PolygonMesh& mesh, MeshFormat format, const MeshWriteOptions& options = {}) {
  std::ostringstream stream;
  write_mesh(stream, format, mesh, options);
  return stream.str();
}

// The bytes of a number, in the order of bytes that is asked for.
template <typename Number>
std::string bytes_of(Number number, std::endian order = std::endian::little) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return order == std::endian::native ? bytes : std::string(bytes.rbegin(), bytes.rend());
}

}  // namespace solidnoise
