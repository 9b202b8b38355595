#pragma once

#include <span>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// Moves each vertex along the surface's normal (SurfaceMesh) by its own amount, world units, positive to the
// outside. Vertices at equal positions move by the mean of their amounts, so that seams stay closed. If the
// mesh has nx ny nz, they become the normals of the new surface. Throws std::invalid_argument: a number of
// amounts that is not that of the vertices, an amount that is not finite, what SurfaceMesh throws.
void displace(PolygonMesh& mesh, std::span<const float> amounts);

// Sets nx ny nz to the surface's normals; the mesh gets these properties if it has none.
void set_normals(PolygonMesh& mesh);

}  // namespace solidnoise
