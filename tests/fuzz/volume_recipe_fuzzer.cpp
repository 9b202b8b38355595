#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume_cost.h"
#include "solidnoise/volume/volume_recipe_json.h"

// Whatever can be read as the recipe of a volume can be written and read again, and where vdbnoise's
// --max-memory and --max-time let it pass, its values on 8 voxels along the longest side are finite numbers.

namespace solidnoise {
namespace {

constexpr double kMostBytes = 5e8;
constexpr double kMostSeconds = 1.5;  // of one core, some thirty times as much under the sanitizers

void require(bool condition) {
  if (!condition) std::abort();
}

void make(VolumeRecipe recipe) {
  recipe.voxel.reset();
  recipe.dim = 8;
  const VolumePlan plan = plan_volume(recipe);
  const Cost cost = volume_cost(recipe, plan, 1);
  if (!(cost.bytes < kMostBytes && cost.seconds < kMostSeconds)) return;
  const Volume volume = make_volume(recipe, plan, "fuzzer");
  // Densities and velocities may be scaled beyond what floats hold, which is refused when they are written.
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) {
    if (measures_density(grid) || grid.density.factor || grid.speed != 1.0) return;
  }
  for (const MeasuredGrid& grid : volume.grids) {
    for (const Moments& moments : grid.moments) {
      require(moments.count() == 0 || (std::isfinite(moments.min()) && std::isfinite(moments.max())));
    }
  }
}

}  // namespace
}  // namespace solidnoise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidnoise;
  try {
    const VolumeRecipe recipe =
        volume_recipe_from_json(parse_json({reinterpret_cast<const char*>(data), size}));
    const Json json = to_json(recipe);
    require(to_json(volume_recipe_from_json(json)) == json);
    make(recipe);
  } catch (const std::invalid_argument&) {
  } catch (const std::runtime_error&) {  // files that are not there
  }
  return 0;
}
