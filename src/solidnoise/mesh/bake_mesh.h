#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/moments.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/steering.h"
#include "solidnoise/mesh/vertex_parameters.h"

namespace solidnoise {

inline constexpr double kHighestCyclesPerEdge = 0.5;
inline constexpr double kMostCounted = 1e7;

// A mesh that is ready to be baked: as densely sampled as the recipe says, with the parameters of every
// vertex. Vertices of the original mesh come first, in their order; new ones follow.
struct BakePlan {
  PolygonMesh mesh;
  VertexGuides guides;
  VertexParameters parameters;
  std::size_t original_vertices = 0;
  std::optional<Box<3>> bounds{};     // BakeVertices::bounds
  double filter = 0.0;                // BakeVertices::filter
  double feature_size = 1.0;          // feature_size_of(), world units
  double mean_edge = 0.0;             // of `mesh`, world units; 0 without edges
  double highest_frequency = 0.0;     // of the noise's band, where it is highest, and of those of layers,
                                      // cycles per world unit
  double mean_cycles_per_edge = 0.0;  // of the highest frequency: above kHighestCyclesPerEdge it aliases
  // Where it does, or would without refining: about how many vertices the mesh takes to show all of the
  // noise (layers that have noises of their own aside), counted up to kMostCounted.
  double vertices_to_show = 0.0;
};

// Measures, refines and steers. Throws std::invalid_argument: recipe.validate(), a mesh whose positions are
// not finite, an attribute that is not there, refining beyond what takes `most_memory` bytes (bake_memory());
// std::runtime_error for a mesh that takes more by itself; Cancelled.
BakePlan plan_bake(PolygonMesh mesh, const BakeRecipe& recipe, Progress* progress = nullptr,
                   std::uint64_t most_memory = std::numeric_limits<std::uint64_t>::max());

// A mesh with its noise.
struct BakedMesh {
  // The plan's mesh with 8-bit colours (red, green, blue, alpha, sRGB-encoded) and the value (`noise`,
  // float32: noise times magnitude plus bias), and the recipe's properties (float32). Displaced along its
  // normals if the recipe says so; nx, ny, nz are then made anew where there are any.
  PolygonMesh mesh;
  std::vector<Vec<3>> normals;  // of the mesh as it is now
  std::vector<Color> colors;    // in linear light
  Moments moments;              // of the values
};

// The numbers that bake() can keep in the mesh, by name: frequency, bandwidth, magnitude, bias, weight (what
// steers, 0 to 1), steering (the number that it is made of), direction (as direction_x, _y, _z); and for
// renderers that displace by vectors, in the same way gradient, the height's along the surface per world
// unit, and curl, that vector turned by a right angle around the normal, which has no divergence along the
// surface.
std::vector<std::string_view> keepable_names();

// Whether a mesh is of points that say no normals either (nx, ny, nz): noise of the tangent plane then lies
// in planes across the y axis, and nothing is displaced.
bool lies_in_unknown_planes(const PolygonMesh& mesh);

// Throws std::invalid_argument if one of the names is not keepable, or not there with this recipe: no
// parameter is a range, the noise is not oriented.
void require_keepable(const std::vector<std::string>& names, const BakeRecipe& recipe);

// Bakes the noise, at rest positions, in parallel. `keep` names what else the mesh shall have. Throws
// std::invalid_argument: require_keepable(); Cancelled.
BakedMesh bake(const BakePlan& plan, const BakeRecipe& recipe, const std::vector<std::string>& keep = {},
               Progress* progress = nullptr);

}  // namespace solidnoise
