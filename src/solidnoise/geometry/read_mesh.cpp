#include "solidnoise/geometry/read_mesh.h"

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_readers.h"

namespace solidnoise {
namespace {

std::string read_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(fmt::format("{}: is a folder, not a mesh", path.string()));
  }
  const auto fail = [&](const char* what) {
    throw std::runtime_error(
        fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(errno)));
  };
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("cannot be read");
  constexpr std::size_t kFirst = std::size_t{1} << 16;
  const auto size = std::filesystem::file_size(path, error);  // not that of a pipe
  std::string bytes(error || size < kFirst ? kFirst : static_cast<std::size_t>(size) + 1, '\0');
  std::size_t count = 0;
  while (stream) {
    if (count == bytes.size()) bytes.resize(2 * bytes.size());
    stream.read(bytes.data() + count, static_cast<std::streamsize>(bytes.size() - count));
    count += static_cast<std::size_t>(stream.gcount());
  }
  if (stream.bad()) fail("reading failed");
  bytes.resize(count);
  return bytes;
}

MeshReading read_format(std::string_view bytes, MeshFormat format, const std::string& name) {
  switch (format) {
    case MeshFormat::ply:
      return read_ply(bytes, name);
    case MeshFormat::obj:
      return read_obj(bytes, name);
    case MeshFormat::off:
      return read_off(bytes, name);
    case MeshFormat::stl:
      return read_stl(bytes, name);
    case MeshFormat::om:
      return read_om(bytes, name);
  }
  throw std::invalid_argument("unknown mesh format");
}

}  // namespace

MeshReading read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = mesh_format(path);
  return read_mesh(read_bytes(path), format, path.string());
}

MeshReading read_mesh(std::string_view bytes, MeshFormat format, const std::string& name) {
  if (bytes.empty()) throw std::runtime_error(fmt::format("{}: the file is empty", name));
  MeshReading reading = read_format(bytes, format, name);
  const PolygonMesh& mesh = reading.mesh;
  if (mesh.positions.empty()) throw std::runtime_error(fmt::format("{}: the mesh has no vertices", name));
  if (mesh.face_count() == 0) {
    throw std::runtime_error(
        fmt::format("{}: the mesh has {} vertices but no faces", name, mesh.positions.size()));
  }
  if (mesh.corners.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::runtime_error(fmt::format("{}: the mesh has more than 2^32 corners of faces", name));
  }
  return reading;
}

}  // namespace solidnoise
