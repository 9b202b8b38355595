#include "solidnoise/geometry/write_mesh.h"

#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_writers.h"

namespace solidnoise {
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
  require_sound_properties(mesh);
  write_output(path, {options.existing, options.progress},
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
  }
}

}  // namespace solidnoise
