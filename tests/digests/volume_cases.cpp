#include <memory>
#include <string>

#include "digests/cases.h"
#include "digests/make_recipes.h"
#include "digests/recipe_files.h"
#include "digests/volume_inputs.h"
#include "support/temporary_folder.h"

namespace solidnoise {
namespace {

// A few blocks of voxels.
constexpr int kDim = 36;

using Folder = std::shared_ptr<const TemporaryFolder>;

// Small, unless the grid that it works on says how large it is.
Json small(Json recipe) {
  recipe.erase("voxel");
  if (recipe.contains("on")) return recipe;
  recipe["dim"] = kDim;
  return recipe;
}

template <typename Add>
DigestCase case_of(const std::string& name, const Folder& folder, const Json& recipe, const Add& add) {
  return {"volume/" + name, [=](Digest& digest) { add(small(with_inputs(recipe, folder->path())), digest); }};
}

}  // namespace

DigestCases volume_cases() {
  const auto folder = std::make_shared<TemporaryFolder>();
  write_volume_inputs(folder->path());
  DigestCases cases;
  Json own = read_json("tests/digests/volumes.json");
  for (auto& [name, recipe] : own.items()) {
    recipe["solidnoise"] = 1;
    cases.push_back(case_of(name, folder, recipe, add_volume));
  }
  for (const auto& [name, recipe] : recipes_in("tools/vdbnoise/presets")) {
    cases.push_back(case_of("preset/" + name, folder, recipe, add_volume));
  }
  for (auto [name, recipe] : recipes_in("examples/recipes")) {
    if (is_of_mesh(recipe)) continue;
    if (recipe["noise"].contains("evolve")) recipe["time"] = 0.7;
    cases.push_back(case_of("example/" + name, folder, recipe, add_volume));
  }
  for (const char* name : {"unit", "cloud", "value,gradient", "layers, warp", "all grids"}) {
    cases.push_back(case_of(
        std::string("merged/") + name, folder, own[name],
        [folder](const Json& recipe, Digest& digest) { add_merged_volume(recipe, folder->path(), digest); }));
  }
  for (const char* name : {"cloud", "period", "veins"}) {
    cases.push_back(case_of(std::string("density factor/") + name, folder, own[name], add_density_factor));
  }
  for (const char* name : {"signed", "unit", "4d", "layers, sum", "layers, mix", "by example"}) {
    cases.push_back(case_of(std::string("points/") + name, folder, own[name], add_volume_points));
  }
  return cases;
}

}  // namespace solidnoise
