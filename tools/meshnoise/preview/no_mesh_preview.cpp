#include "common/usage_error.h"
#include "meshnoise/mesh_preview.h"

namespace solidnoise {

void require_preview(const std::string&) {
  throw UsageError(
      "--preview needs Embree, without which this meshnoise was built; install libembree-dev and build "
      "again");
}

void write_mesh_preview(const std::filesystem::path& path, const PolygonMesh&, std::span<const Vec<3>>,
                        std::span<const Color>, UpAxis) {
  require_preview(path.string());
}

}  // namespace solidnoise
