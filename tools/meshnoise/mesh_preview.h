#pragma once

#include <span>
#include <string>

#include "solidnoise/core/image.h"
#include "solidnoise/core/up_axis.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

// Refuses a preview before any work: throws UsageError if the file is no .png, or if this program was built
// without Embree.
void require_preview(const std::string& path);

// A picture of a mesh in its vertices' colours (linear light).
Image render_mesh_preview(const PolygonMesh& mesh, std::span<const Vec<3>> normals,
                          std::span<const Color> colors, UpAxis up);

}  // namespace solidnoise
