#include <nlohmann/json.hpp>

#include "digests/make_recipes.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"

namespace solidnoise {

void add_bake(const Json& json, const PolygonMesh& mesh, Digest& digest) {
  const BakeRecipe recipe = bake_recipe_from_json(json);
  const PolygonMesh baked = bake(plan_bake(mesh, recipe), recipe).mesh;
  for (const Vec<3>& position : baked.positions) {
    for (int axis = 0; axis < 3; ++axis) digest.add_one(position[axis]);
  }
  digest.add(std::span<const std::uint32_t>(baked.face_starts));
  digest.add(std::span<const std::uint32_t>(baked.corners));
  for (const char* name : {"red", "green", "blue", "alpha", "noise"}) {
    digest.add(std::span<const double>(baked.property(name)->values));
  }
}

}  // namespace solidnoise
