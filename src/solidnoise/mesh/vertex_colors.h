#pragma once

#include <span>

#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

// Gives the vertices colours, one each, in linear light: as the properties red, green, blue and alpha
// (opaque), 8 bits each, sRGB-encoded.
void set_vertex_colors(PolygonMesh& mesh, std::span<const Color> colors);

}  // namespace solidnoise
