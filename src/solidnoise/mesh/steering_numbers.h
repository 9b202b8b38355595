#pragma once

#include <vector>

#include "solidnoise/core/up_axis.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/steering.h"

namespace solidnoise {

// Whether a source is made from the mesh's curvature.
bool is_curvature(SteeringSource source);

// The number that a parameter follows, at each vertex: in 1/world unit (mean, max and abs curvature), 1/world
// unit^2 (Gaussian curvature), world units (height), or as the file has it (attribute). `curvature` is used
// if is_curvature(), and may be empty otherwise. Throws std::invalid_argument: an attribute that the mesh
// does not have, with those that it has; curvature of another mesh.
std::vector<double> steering_numbers(const Steering& steering, const PolygonMesh& mesh,
                                     const Curvature& curvature, UpAxis up = UpAxis::y);

}  // namespace solidnoise
