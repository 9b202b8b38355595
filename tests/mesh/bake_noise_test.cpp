#include "solidnoise/mesh/bake_noise.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::bake_noise_test {
namespace {

constexpr SurfaceNoiseKind kKinds[] = {SurfaceNoiseKind::surface,       SurfaceNoiseKind::oriented,
                                       SurfaceNoiseKind::solid,         SurfaceNoiseKind::kensler,
                                       SurfaceNoiseKind::kensler_solid, SurfaceNoiseKind::spectrum};

// Points spread evenly over a sphere, whose normals they are.
struct Sphere {
  std::vector<Vec<3>> positions;
  std::vector<Vec<3>> normals;
  std::vector<Vec<3>> directions;

  explicit Sphere(std::size_t count, double radius = 1.0) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = normal(random);
      const double y = normal(random);
      const double z = normal(random);
      normals.push_back(glm::normalize(Vec<3>(x, y, z)));
      positions.push_back(radius * normals.back());
      directions.emplace_back(0.0, 1.0, 0.0);
    }
  }

  BakeVertices vertices(double frequency = 8.0) const {
    BakeVertices vertices;
    vertices.positions = positions;
    vertices.normals = normals;
    vertices.directions = directions;
    vertices.frequency.constant = frequency;
    return vertices;
  }
};

SurfaceNoiseRecipe recipe_of(SurfaceNoiseKind kind, int octaves = 1) {
  SurfaceNoiseRecipe recipe;
  recipe.kind = kind;
  recipe.fractal.octaves = octaves;
  recipe.seed = 3;
  if (kind == SurfaceNoiseKind::spectrum) recipe.exemplar = some_spectrum(2).model;
  return recipe;
}

TEST(BakeNoise, SolidNoiseIsTheFieldThatVolumesHave) {
  const Sphere sphere(2000);
  const auto baked = bake_noise(recipe_of(SurfaceNoiseKind::solid, 3), sphere.vertices());
  NoiseRecipe volume{GaborNoiseOptions{.frequency = 8.0, .seed = 3}, {.octaves = 3}};
  const auto noise = make_noise<3>(volume);
  for (std::size_t i = 0; i < baked.size(); ++i) {
    Lattice<3> voxel;
    voxel.origin = sphere.positions[i];
    voxel.count = glm::ivec3(1);
    float value = 0.0f;
    noise->evaluate(voxel, {.values = std::span(&value, 1)});
    // Positions are rounded to 2^-24 of 4 units here and to 2^-20 of a cell there: some 1e-6 of a wavelength.
    EXPECT_NEAR(baked[i], value, 2e-4);
  }
}

TEST(BakeNoise, ByAnExampleInSpaceIsTheFieldThatVolumesHave) {
  const Sphere sphere(500);
  SurfaceNoiseRecipe recipe = recipe_of(SurfaceNoiseKind::spectrum);
  recipe.exemplar = some_spectrum(3).model;
  EXPECT_FALSE(has_direction(recipe));
  const auto baked = bake_noise(recipe, sphere.vertices(2.0));
  const SpectrumNoise<3> noise(
      with_truncation_share(SpectrumNoiseOptions{.model = recipe.exemplar, .frequency = 2.0, .seed = 3}));
  for (std::size_t i = 0; i < baked.size(); ++i) {
    Lattice<3> voxel;
    voxel.origin = sphere.positions[i];
    float value = 0.0f;
    noise.evaluate(voxel, {.values = std::span(&value, 1)});
    EXPECT_NEAR(baked[i], value, 2e-4);
  }
}

TEST(BakeNoise, VariesWithUnitVarianceOverASphere) {
  // A sphere of radius 40 has 80000 squares of a wavelength's side, each about independent: the standard
  // error of the variance is below sqrt(2.5 / 80000) = 0.0056, plus what 20000 points leave unseen, sqrt(2.5
  // / 20000). Four sigma of both: 0.05.
  const Sphere sphere(20000, 40.0);
  for (const SurfaceNoiseKind kind : kKinds) {
    const auto values = bake_noise(recipe_of(kind), sphere.vertices(2.0));
    double sum = 0.0;
    double squares = 0.0;
    for (const float value : values) {
      sum += value;
      squares += value * value;
    }
    EXPECT_NEAR(sum / 20000.0, 0.0, 4.0 * std::sqrt(1.0 / 20000.0)) << static_cast<int>(kind);
    EXPECT_NEAR(squares / 20000.0, 1.0, 0.05) << static_cast<int>(kind);
  }
}

// What an error is allowed for does not move impulses: a draft is the final, up to its error. That of kernels
// is .0433 at .05, which is a correlation of 1 - .0433^2 / 2 = .99906, and the standard error of the mean of
// the squared differences at 20000 points is 2 % of it.
TEST(BakeNoise, ADraftShowsTheFinal) {
  const Sphere sphere(20000, 8.0);
  for (const SurfaceNoiseKind kind : kKinds) {
    if (!is_gabor(kind)) continue;
    for (const bool varies : {false, true}) {
      BakeVertices vertices = sphere.vertices(2.0);
      if (varies) {
        for (const Vec<3>& position : sphere.positions)
          vertices.frequency.values.push_back(static_cast<float>(2.0 + 0.1 * position.y));
      }
      const auto values = [&](double error) {
        SurfaceNoiseRecipe recipe = recipe_of(kind);
        recipe.error = error;
        return bake_noise(recipe, vertices);
      };
      const auto draft = values(0.05);
      const auto fine = values(0.002);
      double products[3] = {};
      for (std::size_t i = 0; i < draft.size(); ++i) {
        products[0] += draft[i] * fine[i];
        products[1] += draft[i] * draft[i];
        products[2] += fine[i] * fine[i];
      }
      EXPECT_GT(products[0] / std::sqrt(products[1] * products[2]), 0.999)
          << static_cast<int>(kind) << ", varies " << varies;
    }
  }
}

// The values of a vertex alone, among others, in another order and with one thread.
TEST(BakeNoise, AValueDependsOnItsVertexOnly) {
  const Sphere sphere(3000);
  for (const SurfaceNoiseKind kind : kKinds) {
    for (const bool varies : {false, true}) {
      const SurfaceNoiseRecipe recipe = recipe_of(kind, 2);
      BakeVertices vertices = sphere.vertices();
      if (varies) {
        for (const Vec<3>& position : sphere.positions) {
          vertices.frequency.values.push_back(static_cast<float>(8.0 + 6.0 * position.y));
        }
      }
      const auto together = bake_noise(recipe, vertices);

      Sphere reversed = sphere;
      std::reverse(reversed.positions.begin(), reversed.positions.end());
      std::reverse(reversed.normals.begin(), reversed.normals.end());
      BakeVertices other = reversed.vertices();
      other.frequency = vertices.frequency;
      std::reverse(other.frequency.values.begin(), other.frequency.values.end());
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      auto backwards = bake_noise(recipe, other);
      std::reverse(backwards.begin(), backwards.end());
      EXPECT_EQ(together, backwards) << static_cast<int>(kind);

      for (const std::size_t i : {0u, 7u, 2999u}) {
        BakeVertices single = vertices;
        single.positions = vertices.positions.subspan(i, 1);
        single.normals = vertices.normals.subspan(i, 1);
        single.directions = vertices.directions.subspan(i, 1);
        if (varies) single.frequency.values = {vertices.frequency.values[i]};
        EXPECT_EQ(bake_noise(recipe, single)[0], together[i]) << static_cast<int>(kind);
      }
    }
  }
}

TEST(BakeNoise, MagnitudeScalesEachVertex) {
  const Sphere sphere(500);
  for (const SurfaceNoiseKind kind : kKinds) {
    const auto plain = bake_noise(recipe_of(kind), sphere.vertices());
    BakeVertices vertices = sphere.vertices();
    for (std::size_t i = 0; i < 500; ++i) vertices.magnitude.values.push_back(static_cast<float>(i) * 0.25f);
    const auto scaled = bake_noise(recipe_of(kind), vertices);
    for (std::size_t i = 0; i < 500; ++i) EXPECT_EQ(scaled[i], plain[i] * static_cast<float>(i) * 0.25f);
  }
}

TEST(BakeNoise, SeedsGiveOtherNoise) {
  const Sphere sphere(4000, 20.0);
  for (const SurfaceNoiseKind kind : kKinds) {
    SurfaceNoiseRecipe other = recipe_of(kind);
    other.seed = 4;
    const auto a = bake_noise(recipe_of(kind), sphere.vertices(2.0));
    const auto b = bake_noise(other, sphere.vertices(2.0));
    const double product = std::inner_product(a.begin(), a.end(), b.begin(), 0.0) / 4000.0;
    EXPECT_NEAR(product, 0.0, 4.0 / std::sqrt(4000.0)) << static_cast<int>(kind);
  }
}

TEST(BakeNoise, LooksAtNoConstantWhereVerticesHaveNumbers) {
  const Sphere sphere(200);
  BakeVertices vertices = sphere.vertices();
  vertices.frequency.values.assign(200, 5.0f);
  vertices.bandwidth.values.assign(200, 1.5f);
  vertices.magnitude.values.assign(200, 2.0f);
  const auto expected = bake_noise(recipe_of(SurfaceNoiseKind::surface), vertices);
  for (const double constant : {0.0, -1.0, 1e300}) {
    vertices.frequency.constant = vertices.bandwidth.constant = vertices.magnitude.constant = constant;
    EXPECT_EQ(bake_noise(recipe_of(SurfaceNoiseKind::surface), vertices), expected) << constant;
  }
}

TEST(BakeNoise, RefusesWhatDoesNotFit) {
  const Sphere sphere(3);
  BakeVertices vertices = sphere.vertices();
  vertices.frequency.values = {1.0f, 0.0f, 2.0f};
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { bake_noise(recipe_of(SurfaceNoiseKind::surface), vertices); }),
      "frequency is 0 at vertex 1; it must be from 1e-12 to 1000000000000");
  vertices.frequency.values = {1.0f, 2.0f};
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { bake_noise(recipe_of(SurfaceNoiseKind::surface), vertices); }),
      "frequency is given for 2 vertices; there are 3");
  vertices.frequency.values = {1.0f, 2.0f, 3.0f};
  vertices.bandwidth.values = {1.0f, 2.0f, 3.0f};
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { bake_noise(recipe_of(SurfaceNoiseKind::kensler), vertices); }),
      "bandwidth cannot vary: this noise has one for all vertices");
  vertices.directions = {};
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { bake_noise(recipe_of(SurfaceNoiseKind::oriented), vertices); }),
      "direction is given for 0 vertices; there are 3");
}

}  // namespace
}  // namespace solidnoise::bake_noise_test
