#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/sound_mesh.h"

namespace solidnoise {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

// Whatever can be read is sound, can be written in every format that holds it, and has the same shape when
// read again; STL has triangles of its own.
void check(const PolygonMesh& mesh) {
  require(fault_of(mesh).empty());
  inspect_mesh(mesh);
  bool has_empty_faces = false;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    has_empty_faces = has_empty_faces || mesh.face(f).empty();
  for (const MeshFormat format : {MeshFormat::ply, MeshFormat::obj, MeshFormat::off, MeshFormat::stl,
                                  MeshFormat::om, MeshFormat::glb}) {
    if (format == MeshFormat::obj && has_empty_faces) continue;
    std::string bytes;
    try {
      bytes = written(mesh, format);
    } catch (const std::invalid_argument&) {
      require(format != MeshFormat::ply && format != MeshFormat::obj);
      continue;
    }
    if (format == MeshFormat::stl) continue;
    if (format == MeshFormat::glb && triangulate(mesh).empty()) continue;  // which is points there
    const PolygonMesh again = read_mesh(bytes, format, "again").mesh;
    require(again.positions.size() == mesh.positions.size());
    if (format == MeshFormat::glb) continue;  // which has triangles
    require(again.face_starts == mesh.face_starts && again.corners == mesh.corners);
  }
}

}  // namespace
}  // namespace solidnoise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidnoise;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  PolygonMesh mesh;
  try {
    mesh = read_mesh(bytes, MeshFormat::SOLIDNOISE_FUZZED_FORMAT, "mesh").mesh;
  } catch (const std::runtime_error& error) {
    require(std::string_view(error.what()).starts_with("mesh:"));
    return 0;
  }
  check(mesh);
  return 0;
}
