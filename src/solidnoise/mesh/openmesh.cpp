#include "solidnoise/mesh/openmesh.h"

namespace solidnoise {

BakedMesh bake_in_place(PolygonMesh mesh, const BakeRecipe& recipe, const std::vector<std::string>& keep,
                        Progress* progress) {
  if (recipe.refine.mode != RefineRecipe::Mode::off) {
    throw std::invalid_argument(
        "refine is on; a mesh that is baked in place keeps its vertices: refine it before, by a subdivider");
  }
  require_keepable(keep, recipe);
  return bake(plan_bake(std::move(mesh), recipe, progress), recipe, keep, progress);
}

}  // namespace solidnoise
