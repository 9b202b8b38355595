// What the page has not: grids, of which recipes are refused before (refuse_files() in recipes.cpp), and
// meshes that OpenMesh reads.

#include <cstddef>
#include <stdexcept>

#include "solidnoise/core/input_file.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/volume/make_volume.h"

namespace solidnoise {
namespace {

[[noreturn]] void refuse() {
  throw std::logic_error("grids are for vdbnoise");
}

[[noreturn]] void refuse_format(const std::string& name) {
  throw std::runtime_error(name +
                           ": the page reads .ply, .obj and .off; meshnoise reads .stl, .om and glTF, too");
}

}  // namespace

std::string read_file(const std::filesystem::path& path, std::uint64_t) {
  throw std::runtime_error(path.string() + ": the page reads no files by their names");
}
MeshReading read_stl(std::string_view, const std::string& name) {
  refuse_format(name);
}
MeshReading read_om(std::string_view, const std::string& name) {
  refuse_format(name);
}
MeshReading read_gltf(std::string_view, MeshFormat, const std::string& name) {
  refuse_format(name);
}

RefinedMesh refine_by_openmesh(const PolygonMesh&, const std::vector<double>&, const RefineOptions&) {
  throw std::invalid_argument(
      "refine.method: the page refines by \"own\"; meshnoise has OpenMesh's methods, too");
}
RefinedMesh subdivide_by_openmesh(const PolygonMesh& mesh, int, const RefineOptions& options) {
  return refine_by_openmesh(mesh, {}, options);
}

int openmesh_rounds(const PolygonMesh& mesh, const std::vector<double>&, RefineOptions::Method) {
  refine_by_openmesh(mesh, {}, {});
  return 0;
}

KernelFields ParameterFields::kernel() const {
  refuse();
}

}  // namespace solidnoise

// Names of types for what std::terminate() prints, where nothing is printed; the standard library's takes 30
// KB.
extern "C" char* __cxa_demangle(const char*, char*, std::size_t*, int* status) {
  if (status != nullptr) *status = -1;
  return nullptr;
}
