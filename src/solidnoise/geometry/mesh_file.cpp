#include "solidnoise/geometry/mesh_file.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/core/extension.h"
#include "solidnoise/core/input_file.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/read_points.h"

namespace solidnoise {
namespace {

constexpr std::array<std::pair<std::string_view, MeshFormat>, 8> kExtensions{{{".ply", MeshFormat::ply},
                                                                              {".obj", MeshFormat::obj},
                                                                              {".off", MeshFormat::off},
                                                                              {".stl", MeshFormat::stl},
                                                                              {".om", MeshFormat::om},
                                                                              {".glb", MeshFormat::glb},
                                                                              {".gltf", MeshFormat::gltf},
                                                                              {".usda", MeshFormat::usda}}};

std::optional<MeshFormat> find_format(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  for (const auto& [name, format] : kExtensions) {
    if (extension == name) return format;
  }
  return std::nullopt;
}

}  // namespace

MeshFormat mesh_format(const std::filesystem::path& path) {
  const std::optional<MeshFormat> format = find_format(path);
  if (!format) {
    throw std::runtime_error(fmt::format(
        "{}: is not a mesh by its name; .ply, .obj, .off, .stl and .om are known, and .glb, .gltf to "
        "read and .usda to write",
        path.string()));
  }
  return *format;
}

bool is_mesh_path(const std::filesystem::path& path) {
  return find_format(path).has_value();
}

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36;

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
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return read_gltf(bytes, format, name);
    case MeshFormat::usda:
      throw std::runtime_error(fmt::format(
          "{}: is of a format that is written only; .ply, .obj, .off, .stl, .om, .glb and .gltf are read",
          name));
  }
  throw std::invalid_argument("unknown mesh format");
}

MeshReading read_bytes(std::string_view bytes, MeshFormat format, const std::string& name, Faces faces) {
  if (bytes.empty()) throw std::runtime_error(fmt::format("{}: the file is empty", name));
  MeshReading reading = read_format(bytes, format, name);
  const PolygonMesh& mesh = reading.mesh;
  if (mesh.positions.empty()) throw std::runtime_error(fmt::format("{}: the mesh has no vertices", name));
  if (mesh.face_count() == 0 && faces == Faces::required) {
    throw std::runtime_error(
        fmt::format("{}: the mesh has {} vertices but no faces", name, mesh.positions.size()));
  }
  if (mesh.corners.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::runtime_error(fmt::format("{}: the mesh has more than 2^32 corners of faces", name));
  }
  return reading;
}

}  // namespace

MeshReading read_mesh(const std::filesystem::path& path) {
  return read_mesh(path, Faces::required);
}

MeshReading read_mesh(const std::filesystem::path& path, Faces faces) {
  if (path == "-") return read_bytes(read_file("/dev/stdin", kMostBytes), MeshFormat::ply, "-", faces);
  const MeshFormat format = mesh_format(path);
  return read_bytes(read_file(path, kMostBytes), format, path.string(), faces);
}

MeshReading read_mesh(std::string_view bytes, MeshFormat format, const std::string& name) {
  return read_bytes(bytes, format, name, Faces::required);
}

namespace {

void require_sound_properties(const PolygonMesh& mesh) {
  std::set<std::string_view> names{"x", "y", "z"};
  for (const VertexProperty& property : mesh.properties) {
    if (property.name.empty() || property.name.find_first_of(" \t\r\n\v\f") != std::string::npos) {
      throw std::invalid_argument(
          fmt::format("'{}' cannot be a property's name: it is empty or has blanks", property.name));
    }
    if (!names.insert(property.name).second) {
      throw std::invalid_argument(fmt::format("there are two properties '{}'", property.name));
    }
    if (property.values.size() != mesh.positions.size()) {
      throw std::invalid_argument(fmt::format("property {} has {} values for {} vertices", property.name,
                                              property.values.size(), mesh.positions.size()));
    }
  }
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  const MeshFormat format = mesh_format(path);
  if (format == MeshFormat::gltf) {
    throw std::runtime_error(
        fmt::format("{}: .gltf files are read only; .glb holds the same", path.string()));
  }
  require_sound_properties(mesh);
  write_output(path, {.existing = options.existing, .progress = options.progress, .group = options.group},
               [&](std::ostream& stream) { write_mesh(stream, format, mesh, options); });
}

void write_mesh(std::ostream& stream, MeshFormat format, const PolygonMesh& mesh,
                const MeshWriteOptions& options) {
  require_sound_properties(mesh);
  switch (format) {
    case MeshFormat::ply:
      return write_ply(stream, mesh, options);
    case MeshFormat::obj:
      return write_obj(stream, mesh, options);
    case MeshFormat::off:
      return write_off(stream, mesh, options);
    case MeshFormat::stl:
      return write_stl(stream, mesh);
    case MeshFormat::om:
      return write_om(stream, mesh);
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return write_glb(stream, mesh, options);
    case MeshFormat::usda:
      return write_usda(stream, mesh, options);
  }
}

}  // namespace solidnoise
