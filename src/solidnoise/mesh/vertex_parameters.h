#pragma once

#include <span>
#include <vector>

#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/steering.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {

// Directions of a surface, for oriented noise: a unit tangent at each vertex, perpendicular to the surface's
// normal there. A direction and its opposite are the same line, so that a field may turn by half a circle
// around a point; such singularities are there on nearly every closed surface. Seams there are none: lines at
// vertices of one point are the same.

// An axis of space, laid into the planes of these unit normals; arbitrary where it is along the normal. The
// axis may have any length but 0, otherwise std::invalid_argument is thrown.
std::vector<Vec<3>> axis_directions(std::span<const Vec<3>> normals, const Vec<3>& axis);

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
// With the smoothing of this surface, which may have been used for others.
std::vector<Vec<3>> curvature_directions(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                                         const Curvature& curvature, PrincipalDirection which, int rounds);

// What a recipe makes of a mesh before any noise: its normals, and what its parameters follow.
struct VertexGuides {
  std::vector<Vec<3>> normals;         // of the surface, unit length
  std::vector<Vec<3>> smooth_normals;  // unit length; empty if they are the surface's
  std::vector<Vec<3>> directions;      // of noise that has one; of oriented noise shorter than 1 where
                                       // lines within a feature do not agree, 0 where they turn around
  std::vector<double> numbers;         // what ranges follow; empty if no parameter is a range
  SteeringWeights steering;            // of the numbers

  // Normals of the planes that noise of the tangent plane lies in.
  const std::vector<Vec<3>>& planes() const { return smooth_normals.empty() ? normals : smooth_normals; }
};

// What a recipe's directions and ranges follow of the curvature.
enum class CurvatureNeeded { none, mean, all };
CurvatureNeeded curvature_needed(const BakeRecipe& recipe);

// Measures the mesh, for a noise of these frequencies. Throws std::invalid_argument: an attribute that the
// vertices do not have (the message names those they have); Cancelled.
VertexGuides measure_guides(const PolygonMesh& mesh, const SurfaceMesh& surface, const BakeRecipe& recipe,
                            const ParameterRange& frequency, Progress* progress);

// Each vertex's share of the surface, world units squared: vertices at one point share its area.
std::vector<double> vertex_areas(const SurfaceMesh& surface);

// The numbers of a steering source, one per vertex; `curvature` is looked at by those that need it. Throws
// like measure_guides().
std::vector<double> steering_numbers(const PolygonMesh& mesh, const Curvature& curvature,
                                     const Steering& steering, UpAxis up);

// The parameters of all vertices, by the weights of the guides.
struct VertexParameters {
  VertexNumber frequency;
  VertexNumber bandwidth;
  VertexNumber magnitude;
  VertexNumber bias;
};

// `frequency` in cycles per world unit: recipe.frequency, or what it is where that is unset.
VertexParameters make_parameters(const BakeRecipe& recipe, const ParameterRange& frequency,
                                 const std::vector<float>& weights);

}  // namespace solidnoise
