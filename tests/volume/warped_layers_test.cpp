// Warped layers of volumes are interpolated, within the error that the recipe allows.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise::warped_layers_test {
namespace {

openvdb::FloatGrid::Ptr make(VolumeRecipe recipe, bool exact) {
  recipe.exact = exact;
  const Volume volume = make_volume(recipe, plan_volume(recipe), "test");
  return openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grids.front().grid);
}

// Root mean square difference over the values' standard deviation, of the voxels of a ball, which are made
// leaf by leaf. Noises of several wavelengths across it have it within a tenth.
double difference_from_exact(const std::string& layer) {
  const VolumeRecipe recipe = volume_recipe_from_json(parse_json(R"({
    "solidnoise": 2, "noise": {"type": "gabor-oriented", "frequency": 1.5, "octaves": 3, "error": 0.05, "seed": 3},
    "grids": [{"name": "n", "shaping": {"type": "raw"}, "layers": [)" +
                                                                 layer + R"(]}],
    "domain": {"shape": {"type": "sphere"}, "dim": 80}})"));
  const auto exact = make(recipe, true);
  const auto interpolated = make(recipe, false);
  EXPECT_TRUE(exact->tree().hasSameTopology(interpolated->tree()));
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double errors = 0.0;
  for (auto value = exact->cbeginValueOn(); value; ++value, ++count) {
    sum += *value;
    squares += std::pow(*value, 2);
    errors += std::pow(*value - interpolated->tree().getValue(value.getCoord()), 2);
  }
  return std::sqrt(errors / (squares - sum * sum / count));
}

// Of the squared error a quarter is that of interpolation, and three quarters are of compact kernels: ripples
// of frequencies that samples do not hold, which the sum has in one way and what is interpolated in another.
// The two differ by sqrt(1/4 + 2 * 3/4) of the error at the most.
TEST(WarpedLayers, AreThoseOfTheSumWithinTheError) {
  const double most = std::sqrt(1.75) * 0.05;
  for (
      const char* layer :
      {R"({"warp": {"amount": 0.2}})", R"({"stretch": [2, 1, 1], "warp": {"amount": 0.1}})",
       R"({"fold": "ridged", "warp": {"amount": 0.1, "noise": {"type": "gabor", "frequency": 1}}})",
       R"({"layers": [{"warp": {"amount": 0.1}}, {"noise": {"type": "gabor", "frequency": 2, "error": 0.05}}],
            "warp": {"amount": 0.1}})"}) {
    const double difference = difference_from_exact(layer);
    EXPECT_LT(difference, most) << layer;
    EXPECT_GT(difference, 0.0) << layer;  // it is not the sum itself
  }
}

}  // namespace
}  // namespace solidnoise::warped_layers_test
