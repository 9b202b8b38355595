#pragma once

#include <span>
#include <string>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/steering.h"

namespace solidnoise {

// Gives the vertices colours, one each, in linear light: as the properties red, green, blue and alpha
// (opaque), 8 bits each, sRGB-encoded.
void set_vertex_colors(PolygonMesh& mesh, std::span<const Color> colors);

// How the curvature of a mesh is to be shown.
struct CurvatureRecipe {
  Steering by;                 // what the colours show; not an attribute
  int smooth = 2;              // rounds, 0 to 10000
  double smooth_radius = 0.0;  // world units, >= 0
  std::string ramp = "viridis";
  UpAxis up = UpAxis::y;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

struct ShownCurvature {
  // The mesh with colours, and the numbers mean_curvature, gaussian_curvature, k1 and k2 (float32).
  PolygonMesh mesh;
  std::vector<Vec<3>> normals;
  std::vector<Color> colors;  // in linear light
  SteeringWeights steering;
};

// Throws std::invalid_argument: recipe.validate(), positions that are not finite.
ShownCurvature show_curvature(const PolygonMesh& mesh, const CurvatureRecipe& recipe);

}  // namespace solidnoise
