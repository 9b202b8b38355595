// Noise on surfaces that changes with time: impulses that turn, and frames of noises of four dimensions.
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/independent_values.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::bake_time_test {
namespace {

// Points on a large sphere, a golden spiral: 1.4 wavelengths apart at frequency 8, so that they hardly
// correlate.
struct Globe {
  static constexpr double kRadius = 5.0;
  std::vector<Vec<3>> positions, normals, directions;

  explicit Globe(int count = 8000) {
    for (int i = 0; i < count; ++i) {
      const double height = 1.0 - (2.0 * i + 1.0) / count;
      const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double width = std::sqrt(1.0 - height * height);
      normals.emplace_back(width * std::cos(turn), width * std::sin(turn), height);
      positions.push_back(kRadius * normals.back());
      directions.emplace_back(0.0, 1.0, 0.0);
    }
  }

  std::vector<float> bake(const SurfaceNoiseRecipe& recipe, bool varies = false) const {
    BakeVertices vertices;
    vertices.positions = positions;
    vertices.normals = normals;
    vertices.directions = directions;
    vertices.frequency.constant = 8.0;
    for (std::size_t i = 0; varies && i < positions.size(); ++i) {
      vertices.frequency.values.push_back(8.0f + static_cast<float>(positions[i].y / kRadius));
    }
    return bake_noise(recipe, vertices);
  }
};

struct Case {
  SurfaceNoiseKind kind;
  int dims;
  bool varies = false;
};
constexpr Case kCases[] = {{SurfaceNoiseKind::surface, 3},       {SurfaceNoiseKind::surface, 3, true},
                           {SurfaceNoiseKind::oriented, 3},      {SurfaceNoiseKind::solid, 3},
                           {SurfaceNoiseKind::solid, 3, true},   {SurfaceNoiseKind::solid, 4},
                           {SurfaceNoiseKind::solid, 4, true},   {SurfaceNoiseKind::kensler, 3},
                           {SurfaceNoiseKind::kensler, 3, true}, {SurfaceNoiseKind::kensler_solid, 4},
                           {SurfaceNoiseKind::spectrum, 3}};

// Of one that loops, where it can.
SurfaceNoiseRecipe recipe_of(const Case& of, double time) {
  SurfaceNoiseRecipe recipe;
  recipe.kind = of.kind;
  recipe.dims = of.dims;
  recipe.time = time;
  recipe.seed = 3;
  recipe.fractal.octaves = 2;
  if (of.dims == 3) recipe.evolve = 0.25;
  if (of.dims == 3 || !of.varies) recipe.loop = 4.0;
  if (of.kind == SurfaceNoiseKind::spectrum) recipe.exemplar = some_spectrum(2).model;
  return recipe;
}

TEST(BakeTime, ALoopEndsWhereItBegins) {
  const Globe globe(600);
  for (const Case& of : kCases) {
    if (of.dims == 4 && of.varies) continue;  // has no period
    SCOPED_TRACE(testing::Message() << static_cast<int>(of.kind) << ' ' << of.dims << ' ' << of.varies);
    const auto first = globe.bake(recipe_of(of, 1.25), of.varies);
    EXPECT_EQ(globe.bake(recipe_of(of, 5.25), of.varies), first);
    EXPECT_EQ(globe.bake(recipe_of(of, -2.75), of.varies), first);
    EXPECT_NE(globe.bake(recipe_of(of, 1.5), of.varies), first);
  }
}

TEST(BakeTime, EachFrameHasUnitVariance) {
  const Globe globe;
  for (const Case& of : kCases) {
    SCOPED_TRACE(testing::Message() << static_cast<int>(of.kind) << ' ' << of.dims << ' ' << of.varies);
    for (const double time : {0.7, 2.9}) {
      const auto values = globe.bake(recipe_of(of, time), of.varies);
      // Neighbours correlate a little, and so do the squares: 6 of the standard errors of independent values.
      const Estimate square = estimate_mean(values, [](double x) { return x * x; });
      EXPECT_NEAR(square.mean, 1.0, 6.0 * square.error) << "time " << time;
    }
  }
}

// Of one octave. The correlation of 8000 values has a standard error of 0.011; 5 of them.
TEST(BakeTime, FramesAreCorrelatedByTheClosedForm) {
  const Globe globe;
  for (const Case& of : kCases) {
    if (of.dims == 4) continue;
    SCOPED_TRACE(testing::Message() << static_cast<int>(of.kind) << ' ' << of.varies);
    SurfaceNoiseRecipe recipe = recipe_of(of, 0.4);
    recipe.fractal.octaves = 1;
    const auto first = globe.bake(recipe, of.varies);
    for (const double lag : {0.5, 1.1}) {
      recipe.time = 0.4 + lag;
      const auto later = globe.bake(recipe, of.varies);
      double product = 0.0;
      for (std::size_t i = 0; i < first.size(); ++i)
        product += double(first[i]) * double(later[i]) / double(first.size());
      EXPECT_NEAR(product, evolution_correlation(recipe.evolution(), lag), 0.055) << lag;
    }
  }
}

TEST(BakeTime, OfSolidNoiseIsTheFrameThatVolumesHave) {
  const Globe globe(500);
  SurfaceNoiseRecipe recipe = recipe_of({SurfaceNoiseKind::solid, 4}, 0.7);
  const auto frame =
      slice(make_noise<4>({GaborNoiseOptions{.frequency = 8.0, .seed = 3, .period = {0.0, 0.0, 0.0, 4.0}},
                           {.octaves = 2}}),
            0.7);
  std::vector<float> expected(globe.positions.size());
  frame->evaluate(Points<3>{globe.positions}, {.values = expected});
  EXPECT_EQ(globe.bake(recipe), expected);
}

TEST(BakeTime, KenslersNoiseIsTheOneThatStandsStillAtTime0) {
  const Globe globe(500);
  const Case kensler{SurfaceNoiseKind::kensler, 3};
  SurfaceNoiseRecipe still = recipe_of(kensler, 0.0);
  still.evolve = still.loop = 0.0;
  EXPECT_EQ(globe.bake(recipe_of(kensler, 0.0)), globe.bake(still));
}

TEST(BakeTime, IsOfNoisesOfPropertiesToo) {
  BakeRecipe recipe;
  EXPECT_FALSE(recipe.changes_with_time());
  GaborNoiseOptions evolving;
  evolving.evolution.rate = 0.5;
  recipe.properties["height"].noise = NoiseRecipe{evolving, {}};
  EXPECT_TRUE(recipe.changes_with_time());
}

TEST(BakeTime, RefusesWhatHasNoEffect) {
  const auto refusal = [](const auto& change) {
    SurfaceNoiseRecipe recipe;
    change(recipe);
    return message_of<std::invalid_argument>([&] { recipe.validate(); });
  };
  EXPECT_EQ(refusal([](auto& recipe) { recipe.dims = 4; }),
            "dims is 4; it applies to solid and kensler-solid noise, others evolve");
  EXPECT_TRUE(refusal([](auto& recipe) {
                recipe.kind = SurfaceNoiseKind::kensler_solid;
                recipe.evolve = 0.5;
              }).starts_with("evolve is 0.5"));
  EXPECT_TRUE(refusal([](auto& recipe) { recipe.loop = 2.0; }).starts_with("loop is 2"));
  EXPECT_TRUE(refusal([](auto& recipe) {
                recipe.kind = SurfaceNoiseKind::solid;
                recipe.dims = 4;
                recipe.evolve = 0.5;
              }).starts_with("dims is 4; it must be 3"));
}

}  // namespace
}  // namespace solidnoise::bake_time_test
