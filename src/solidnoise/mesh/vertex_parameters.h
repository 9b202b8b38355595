#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/steering.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {

// What a recipe makes of a mesh before any noise: its normals, and what its parameters follow.
struct VertexGuides {
  std::vector<Vec<3>> normals;     // unit length
  std::vector<Vec<3>> directions;  // unit length or 0; of oriented noise only
  std::vector<double> numbers;     // what ranges follow; empty if no parameter is a range
  SteeringWeights steering;        // of the numbers
};

// Measures the mesh. Throws std::invalid_argument: an attribute that the vertices do not have (the message
// names those they have).
VertexGuides measure_guides(const PolygonMesh& mesh, const SurfaceMesh& surface, const BakeRecipe& recipe);

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
