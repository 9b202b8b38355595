#pragma once

#include <span>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

struct MeshPictureOptions {
  int width = 640;   // pixels; 16 to 8192
  int height = 640;  // pixels; 16 to 8192
  UpAxis up = UpAxis::y;
  double turn = 0.0;        // of the camera around the mesh, degrees to the right; finite
  double elevation = 16.0;  // of the camera over the horizon, degrees; -85 to 85
};

// A picture of a mesh in its vertices' colours (linear light, one per vertex; interpolated): lit by a sun
// that casts shadows and by the sky as far as the mesh does not hide it, over a ground that shows its shadow
// alone, before a plain background, seen at three quarters from a little above, framed by its triangles.
// Where the sun shines a colour shows as about what it is: light is 1 at 45 degrees from the sun. `normals`
// has one unit vector per vertex, which shades it smoothly; faces are seen from both sides. Rays are cast by
// Embree, in parallel; the picture is the same for any number of threads. Three channels, sRGB-encoded, 0
// to 1. A mesh without triangles gives the background. Throws std::invalid_argument if an option is out of
// range or a span's size is not the number of vertices.
Image render_mesh(const PolygonMesh& mesh, std::span<const Vec<3>> normals, std::span<const Color> colors,
                  const MeshPictureOptions& options = {});

}  // namespace solidnoise
