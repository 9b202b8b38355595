#pragma once

#include <span>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// Moves each vertex along its normal by its own amount, world units. `normals` have length 1 and are the same
// for vertices of one point (see SurfaceMesh), which move by the mean of their amounts, so that seams stay
// closed. (A surface's own normals are SurfaceMesh's; where its faces were cut up, those that it had before
// are smoother.) If the mesh has nx ny nz, they become the normals of the new surface. Throws
// std::invalid_argument: a number of normals or amounts that is not that of the vertices, an amount that is
// not finite, what SurfaceMesh throws.
void displace(PolygonMesh& mesh, std::span<const Vec<3>> normals, std::span<const float> amounts);

// Sets nx ny nz to the surface's normals; the mesh gets these properties if it has none.
void set_normals(PolygonMesh& mesh);

}  // namespace solidnoise
