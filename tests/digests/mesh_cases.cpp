#include <cmath>
#include <string>
#include <vector>

#include "digests/cases.h"
#include "digests/make_recipes.h"
#include "digests/recipe_files.h"
#include "solidnoise/geometry/mesh_file.h"
#include "support/paths.h"

namespace solidnoise {
namespace {

// A sample mesh with a number of its own, `heat`.
PolygonMesh warm_torus() {
  PolygonMesh mesh = read_mesh(in_source("meshes/torus.obj")).mesh;
  std::vector<double> heat;
  for (const Vec<3>& position : mesh.positions) heat.push_back(position.x + 0.5 * position.z);
  mesh.set_property({"heat", ScalarType::float64, heat});
  return mesh;
}

DigestCase case_of(const std::string& name, const Json& recipe) {
  return {"mesh/" + name, [recipe](Digest& digest) { add_bake(recipe, warm_torus(), digest); }};
}

}  // namespace

DigestCases mesh_cases() {
  DigestCases cases;
  Json own = read_json("tests/digests/meshes.json");
  for (auto& [name, recipe] : own.items()) {
    recipe["solidnoise"] = 1;
    cases.push_back(case_of(name, recipe));
  }
  for (const auto& [name, recipe] : recipes_in("tools/meshnoise/presets")) {
    cases.push_back(case_of("preset/" + name, recipe));
  }
  for (const auto& [name, recipe] : recipes_in("examples/recipes")) {
    if (is_of_mesh(recipe)) cases.push_back(case_of("example/" + name, recipe));
  }
  return cases;
}

}  // namespace solidnoise
