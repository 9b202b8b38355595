#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/make_volume.h"

namespace solidnoise::density_factor_test {
namespace {

VolumeRecipe small_smoke() {
  VolumeRecipe recipe;
  recipe.noise.noise = GaborNoiseOptions{.frequency = 2.0};
  recipe.shaping = RemapShaping{.threshold = 0.5, .edge = 1.0};
  recipe.box = {{-1.0, -1.3, -0.4}, {1.0, 1.1, 0.6}};
  recipe.dim = 150;  // three slabs along y, the first and the last of them cut
  return recipe;
}

double noted_factor(const Volume& volume) {
  const auto factor =
      volume.grids.front().grid->getMetadata<openvdb::DoubleMetadata>("solidnoise:density_factor");
  return factor == nullptr ? 0.0 : factor->value();
}

// Slab by slab it is what a volume made in one piece is scaled by, to the last bit, whatever part is planned.
TEST(DensityFactor, OfSlabsIsThatOfTheWhole) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    for (const auto peak : {std::optional<double>(), std::optional<double>(3.0)}) {
      VolumeRecipe recipe = small_smoke();
      recipe.up = up;
      recipe.density.peak = peak;
      const double whole = noted_factor(make_volume(recipe, plan_volume(recipe), "test"));
      ASSERT_GT(whole, 0.0);
      const VolumePlan plan = plan_volume(recipe, {.shard = 2, .shards = 3});
      EXPECT_EQ(measure_density_factor(recipe, plan), whole);
    }
  }
}

TEST(DensityFactor, OfTheRecipeIsTaken) {
  VolumeRecipe recipe = small_smoke();
  recipe.density.factor = 2.5;
  const Volume given = make_volume(recipe, plan_volume(recipe), "test");
  EXPECT_EQ(noted_factor(given), 2.5);
  recipe.density.factor = 5.0;
  const Volume doubled = make_volume(recipe, plan_volume(recipe), "test");
  EXPECT_EQ(doubled.grids.front().moments.front().max(), 2.0 * given.grids.front().moments.front().max());
}

TEST(DensityFactor, OfNothingIsNone) {
  VolumeRecipe recipe = small_smoke();
  recipe.dim = 16;
  recipe.shaping = RemapShaping{.threshold = 50.0};
  EXPECT_EQ(measure_density_factor(recipe, plan_volume(recipe)), std::nullopt);
  EXPECT_EQ(noted_factor(make_volume(recipe, plan_volume(recipe), "test")), 1.0);
}

}  // namespace
}  // namespace solidnoise::density_factor_test
