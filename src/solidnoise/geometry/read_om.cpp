#include <algorithm>
#include <sstream>
#include <utility>

#include <OpenMesh/Core/IO/reader/OMReader.hh>

#include "solidnoise/geometry/check_om.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/mesh_importer.h"
#include "solidnoise/geometry/openmesh_session.h"

namespace solidnoise {

MeshReading read_om(std::string_view bytes, const std::string& name) {
  CheckedOm checked = check_om(bytes, name);
  MeshImporter importer(name, checked.header.n_vertices_);
  {
    const OpenMeshSession session;
    std::istringstream stream(std::move(checked.bytes));
    OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexNormal | OpenMesh::IO::Options::VertexColor);
    OpenMesh::IO::OMReader().read(stream, importer, options);
  }
  MeshReading reading{importer.take_mesh(), {}, std::move(checked.notes)};
  for (VertexProperty& property : reading.mesh.properties) {
    const bool is_color =
        std::find(kColorNames.begin(), kColorNames.end(), property.name) != kColorNames.end();
    if (is_color) property.type = ScalarType::uint8;
  }
  for (const auto& [property, type] : checked.properties) {
    reading.mesh.set_property(importer.property(property, type));
  }
  return reading;
}

}  // namespace solidnoise
