#pragma once

#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {

// Directions of a surface, for oriented noise: a unit tangent at each vertex, perpendicular to the surface's
// normal there. A direction and its opposite are the same line, so that a field may turn by half a circle
// around a point; such singularities are there on nearly every closed surface. Seams there are none: lines at
// vertices of one point are the same.

// An axis of space, laid into the tangent plane; arbitrary where it is along the normal. The axis may have
// any length but 0, otherwise std::invalid_argument is thrown.
std::vector<Vec<3>> axis_directions(const SurfaceMesh& surface, const Vec<3>& axis);

enum class PrincipalDirection {
  larger,   // along which the curvature has the larger magnitude: across ridges and creases, around a tube
  smaller,  // perpendicular to it: along ridges and creases
};

// A principal direction of the curvature, smoothed by `rounds` (0 to 10000) of averaging with the neighbours:
// lines are averaged as complex numbers of twice the angle, carried from one tangent plane to the next, and
// weighted by area and by anisotropy, the difference of the magnitudes of the principal curvatures. Where the
// surface is flat or round (anisotropy below 1/50 of the mesh's root mean square curvature) the direction
// is continued from the nearest vertices that have one; a component that has none gets axis_directions() of
// +Y. Throws std::invalid_argument: rounds out of range, curvature of another mesh.
std::vector<Vec<3>> curvature_directions(const SurfaceMesh& surface, const Curvature& curvature,
                                         PrincipalDirection which, int rounds);

}  // namespace solidnoise
