#include <fmt/format.h>

#include "common/run_tool.h"
#include "meshnoise/mesh_files.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/render/render_mesh.h"

namespace solidnoise {

void require_preview(const std::string& path) {
  if (extension_of(path) != ".png")
    throw UsageError(fmt::format("--preview is {}; it must end in .png", path));
}

Image render_mesh_preview(const PolygonMesh& mesh, std::span<const Vec<3>> normals,
                          std::span<const Color> colors, UpAxis up, const MeshView& options) {
  return render_mesh(mesh, normals, colors,
                     {.width = options.size,
                      .height = options.size,
                      .up = up,
                      .turn = options.turn,
                      .elevation = options.elevation});
}

}  // namespace solidnoise
