#include "common/run_tool.h"
#include "meshnoise/mesh_files.h"

namespace solidnoise {

void require_preview(const std::string&) {
  throw UsageError(
      "--preview needs Embree, without which this meshnoise was built; install libembree-dev and build "
      "again");
}

Image render_mesh_preview(const PolygonMesh&, std::span<const Vec<3>>, std::span<const Color>, UpAxis,
                          const MeshView&) {
  return {};
}

}  // namespace solidnoise
