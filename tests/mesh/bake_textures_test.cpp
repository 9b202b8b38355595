#include "solidnoise/mesh/bake_textures.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "support/message_of.h"

namespace solidnoise::bake_textures_test {
namespace {

constexpr int kSize = 256;

// A sheet of squares, with where its corners are in textures.
struct Sheet {
  PolygonMesh mesh;
  std::vector<Vec<2>> corners;

  // Columns first to end of a grid, at `place` of a column and row.
  template <typename Place>
  void add_faces(int first, int end, int rows, const Place& place) {
    for (int i = first; i < end; ++i) {
      for (int j = 0; j < rows; ++j) {
        const auto number = [&](int a, int b) { return static_cast<std::uint32_t>(a * (rows + 1) + b); };
        mesh.add_face(std::vector{number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
        for (const auto& [a, b] :
             {std::pair(i, j), std::pair(i + 1, j), std::pair(i + 1, j + 1), std::pair(i, j + 1)})
          corners.push_back(place(a, b));
      }
    }
  }
};

Vec<2> at_texel(double x, double y) {
  return {(x + 0.5) / kSize, 1.0 - (y + 0.5) / kSize};
}

// A part of a cylinder that is two islands, the second twice as fine, which meet at the column 8: at the
// texels x of 74 and of 100, row by row from 20 to 148.
Sheet two_islands() {
  Sheet sheet;
  for (int i = 0; i <= 16; ++i) {
    for (int j = 0; j <= 8; ++j) {
      const double angle = 0.125 * i;
      sheet.mesh.positions.emplace_back(std::sin(angle), 0.25 * j, std::cos(angle));
    }
  }
  sheet.add_faces(0, 8, 8, [](int i, int j) { return at_texel(10.0 + 8.0 * i, 20.0 + 16.0 * (8 - j)); });
  sheet.add_faces(8, 16, 8,
                  [](int i, int j) { return at_texel(100.0 + 16.0 * (i - 8), 20.0 + 16.0 * (8 - j)); });
  return sheet;
}

// A square of side `length` in the plane z = 0.3 that fills the texture.
Sheet square(double length, bool mirrored = false) {
  Sheet sheet;
  for (int i = 0; i <= 1; ++i) {
    for (int j = 0; j <= 1; ++j) sheet.mesh.positions.emplace_back(length * i, length * j, 0.3);
  }
  sheet.add_faces(0, 1, 1, [&](int i, int j) { return Vec<2>(mirrored ? 1 - i : i, j); });
  return sheet;
}

TexturePlan plan(const Sheet& sheet, const BakeRecipe& recipe,
                 const TextureOptions& options = {.size = kSize}) {
  return plan_textures(plan_bake(sheet.mesh, recipe), sheet.corners, TextureTiles::udim, options);
}

Image bake_map(const TexturePlan& textures, const BakeRecipe& recipe, const char* name) {
  return bake_tile(textures, recipe, {texture_map(name, recipe)}, textures.tiles.front()).images.front();
}

BakeRecipe recipe_of(double frequency, SurfaceNoiseKind kind = SurfaceNoiseKind::surface) {
  BakeRecipe recipe;
  recipe.noise.kind = kind;
  recipe.frequency = ParameterRange{frequency, frequency};
  return recipe;
}

// The positions of the two agree to the last bits, and the filters of their texels, though those of the
// second are half as long: in single precision positions, and so values, are the same.
TEST(BakeTextures, IslandsAgreeWhereTheyMeet) {
  for (const SurfaceNoiseKind kind :
       {SurfaceNoiseKind::surface, SurfaceNoiseKind::oriented, SurfaceNoiseKind::solid}) {
    BakeRecipe recipe = recipe_of(6.0, kind);
    recipe.noise.fractal.octaves = 4;
    recipe.properties["height"] = {.use = "value", .ramp = {{-1.0, 0.0}, {2.0, 1.0}}};
    for (const char* map : {"noise", "height", "color"}) {
      const Image image = bake_map(plan(two_islands(), recipe), recipe, map);
      double difference = 0.0;
      double next = 0.0;
      for (int y = 20; y <= 148; ++y) {
        difference = std::max(difference, std::abs(double{image.at(74, y)} - double{image.at(100, y)}));
        next = std::max(next, std::abs(double{image.at(73, y)} - double{image.at(100, y)}));
      }
      EXPECT_EQ(difference, 0.0) << map;
      EXPECT_GT(next, 0.02) << map;
    }
  }
}

// Half-way between the last texel of an island and the one beyond, interpolation gives what the surface has
// there.
TEST(BakeTextures, InterpolationContinuesAcrossAnIslandsEdge) {
  const BakeRecipe recipe = recipe_of(1.0);
  Sheet sheet = square(2.0);
  for (Vec<2>& corner : sheet.corners) corner = 0.25 + 0.5 * corner;  // texels from 63.5 to 191.5
  const Image image = bake_map(plan(sheet, recipe), recipe, "noise");
  for (int y = 70; y < 190; ++y) {
    // The second difference of texels a 64th of a wave long has a standard deviation of 0.012; without what
    // is beyond the edge the first one would be half of what it is, 0.1.
    EXPECT_NEAR(image.at(63, y) - image.at(64, y), image.at(64, y) - image.at(65, y), 0.06) << y;
  }
}

TEST(BakeTextures, HasTheVarianceThatTexelsLeave) {
  constexpr double kFrequency = 4.0;
  constexpr double kLength = 38.4;  // 0.15 for a texel: 0.6 cycles
  const BakeRecipe recipe = recipe_of(kFrequency);
  const TexturePlan textures = plan(square(kLength), recipe);
  const Image image = bake_map(textures, recipe, "noise");
  const double deviation = 0.5 * kLength / kSize;
  EXPECT_NEAR(textures.most_deviation(), deviation, 1e-6);
  const SurfaceGaborNoise noise({.frequency = kFrequency, .error = recipe.noise.error, .filter = deviation});
  double sum = 0.0;
  for (const float value : image.pixels) sum += double{value} * double{value};
  const double variance = sum / (kSize * kSize);
  // The variance of the mean square is 2 / area times the integral of the squared spectrum, which is that of
  // noise in the plane; five standard deviations, one false alarm in two million, and the error of compact
  // kernels.
  const GaborNoise<2> plane({.frequency = kFrequency, .error = recipe.noise.error, .filter = deviation});
  const double squared = integrate(
      [&](double f) {
        return 2.0 * kPi * f * std::pow(plane.power_spectrum({f, 0.0}), 2);
      },
      0.0, 12.0, 100);
  const double bound = 5.0 * std::sqrt(2.0 * squared) / kLength + recipe.noise.error * noise.variance();
  EXPECT_GT(noise.variance(), 0.03);
  EXPECT_LT(noise.variance(), 0.3);
  EXPECT_LT(bound, 0.1 * noise.variance());
  EXPECT_NEAR(variance, noise.variance(), bound);
}

TEST(BakeTextures, NormalsHaveTheSlopesOfHeights) {
  for (const bool mirrored : {false, true}) {
    for (const bool folded : {false, true}) {
      BakeRecipe recipe = recipe_of(1.0);
      recipe.displace = 0.05;
      // A crest has no gradient in closed form.
      recipe.properties["height"] =
          folded ? Layer{.fold = Layer::Fold::crest} : Layer{.use = "value", .weight = 2.0, .bias = 1.0};
      const TexturePlan textures = plan(square(4.0, mirrored), recipe);
      const Image heights = bake_map(textures, recipe, "height");
      const Image normals = bake_map(textures, recipe, "normal");
      const double texel = 4.0 / kSize;
      double error = 0.0;
      double power = 0.0;
      for (int y = 1; y < kSize - 1; ++y) {
        for (int x = 1; x < kSize - 1; ++x) {
          const double along_u = (heights.at(x + 1, y) - heights.at(x - 1, y)) / (2.0 * texel);
          const double along_v = (heights.at(x, y - 1) - heights.at(x, y + 1)) / (2.0 * texel);
          const Vec<3> expected = glm::normalize(Vec<3>(-0.05 * along_u, -0.05 * along_v, 1.0));
          for (int c = 0; c < 3; ++c) {
            error += std::pow(2.0 * normals.at(x, y, c) - 1.0 - expected[c], 2);
            power += c < 2 ? expected[c] * expected[c] : 0.0;
          }
        }
      }
      // Differences over two texels of 1/64 of a wave are off by (2 pi / 64)^2 / 6 = 0.0016 of a slope;
      // crests have kinks.
      EXPECT_LT(std::sqrt(error / power), folded ? 0.1 : 0.005) << mirrored << folded;
    }
  }
}

// A ramp that steps within a thousandth of a texel: the slopes of texels at the step are those of the
// heights, and those of the others are 0.
TEST(BakeTextures, NormalsOfStepsAreThoseOfTexels) {
  BakeRecipe recipe = recipe_of(1.0);
  recipe.displace = 0.05;
  recipe.properties["height"] = {.use = "value", .ramp = {{0.0, 0.0}, {1e-5, 1.0}}};
  const TexturePlan textures = plan(square(4.0), recipe);
  const Image heights = bake_map(textures, recipe, "height");
  const Image normals = bake_map(textures, recipe, "normal");
  const double texel = 4.0 / kSize;
  double product = 0.0;
  double of_heights = 0.0;
  double of_normals = 0.0;
  for (int y = 1; y < kSize - 1; ++y) {
    for (int x = 1; x < kSize - 1; ++x) {
      const Vec<2> expected =
          0.05 / (2.0 * texel) *
          Vec<2>(heights.at(x - 1, y) - heights.at(x + 1, y), heights.at(x, y + 1) - heights.at(x, y - 1));
      const Vec<3> normal = 2.0 * Vec<3>(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2)) - 1.0;
      const Vec<2> slope = Vec<2>(normal) / normal.z;
      product += glm::dot(slope, expected);
      of_heights += glm::dot(expected, expected);
      of_normals += glm::dot(slope, slope);
    }
  }
  // Over one texel a step is half as often, and twice as steep, as over the two of the heights' differences.
  EXPECT_GT(product / std::sqrt(of_heights * of_normals), 0.6);
  EXPECT_NEAR(of_normals / of_heights, 2.0, 0.3);
}

TEST(BakeTextures, PadsByWhatIsNextToIt) {
  BakeRecipe recipe = recipe_of(1.0);
  recipe.ramp = "0:#808080,1:#808080";
  Sheet sheet = square(2.0);
  for (Vec<2>& corner : sheet.corners) corner = 0.25 + 0.5 * corner;  // texels from 63.5 to 191.5
  const Image image = bake_map(plan(sheet, recipe, {.size = kSize, .padding = 5}), recipe, "color");
  const float grey = image.at(128, 128);
  EXPECT_GT(grey, 0.2f);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int outside = std::max({64 - x, 64 - y, x - 191, y - 191, 0});
      if (outside <= 6) {
        EXPECT_NEAR(image.at(x, y), grey, 1e-6) << x << ' ' << y;
      }
      if (outside > 7) {
        EXPECT_EQ(image.at(x, y), 0.0f) << x << ' ' << y;
      }
    }
  }
}

TEST(BakeTextures, NumbersItsTiles) {
  Sheet sheet = square(2.0);
  const std::vector<Vec<2>> base = sheet.corners;
  for (const auto& [column, row, udim] :
       {std::tuple(0, 0, 1001), std::tuple(9, 0, 1010), std::tuple(2, 3, 1033)}) {
    for (std::size_t i = 0; i < base.size(); ++i) sheet.corners[i] = base[i] + Vec<2>(column, row);
    const TexturePlan textures = plan(sheet, recipe_of(1.0));
    ASSERT_EQ(textures.tiles.size(), 1u);
    EXPECT_EQ(textures.tiles.front().udim, udim);
  }
  for (std::size_t i = 0; i < base.size(); ++i) sheet.corners[i] = 0.5 + base[i];
  const TexturePlan textures = plan(sheet, recipe_of(1.0));
  ASSERT_EQ(textures.tiles.size(), 4u);
  EXPECT_EQ(textures.tiles.back().udim, 1012);
}

TEST(BakeTextures, RefusesCoordinatesOutsideOfTiles) {
  Sheet sheet = square(2.0);
  const BakeRecipe recipe = recipe_of(1.0);
  const auto refusal = [&](const Vec<2>& shift, TextureTiles tiles) {
    std::vector<Vec<2>> corners = sheet.corners;
    for (Vec<2>& corner : corners) corner += shift;
    return message_of<std::invalid_argument>(
        [&] { plan_textures(plan_bake(sheet.mesh, recipe), corners, tiles, {.size = 16}); });
  };
  EXPECT_NE(refusal({1.0, 0.0}, TextureTiles::one).find("face 0 are 2 0; they must be from 0 to 1"),
            std::string::npos);
  EXPECT_NE(refusal({-1.0, 0.0}, TextureTiles::udim).find("face 0 are -1 0"), std::string::npos);
  EXPECT_NE(refusal({0.0, 10.0}, TextureTiles::udim).find("1001 to 1100"), std::string::npos);
  EXPECT_EQ(refusal({9.0, 9.0}, TextureTiles::udim), "nothing was thrown");
}

TEST(BakeTextures, CountsFacesThatOverlapOrHaveNoArea) {
  Sheet sheet = square(2.0);
  sheet.add_faces(0, 1, 1, [](int i, int j) { return Vec<2>(0.5 * i, 0.5 * j); });
  sheet.add_faces(0, 1, 1, [](int i, int) { return Vec<2>(0.5 * i, 0.25); });
  const BakeRecipe recipe = recipe_of(1.0);
  const TexturePlan textures = plan(sheet, recipe);
  EXPECT_EQ(textures.without_area, 2u);
  const BakedTile tile = bake_tile(textures, recipe, {texture_map("noise", recipe)}, textures.tiles.front());
  EXPECT_NEAR(static_cast<double>(tile.overlapped), 128.0 * 128.0, 2 * 128.0);
  for (Vec<2>& corner : sheet.corners) corner = Vec<2>(0.5);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { plan(sheet, recipe); }),
            "none of the faces has an area in its texture coordinates");
}

TEST(BakeTextures, MixesFiltersOfTheTexelsVariance) {
  const FilterLevels levels(0.1, 0.5);
  ASSERT_GT(levels.deviations().size(), 2u);
  for (double deviation = 0.1; deviation <= 0.5; deviation += 0.01) {
    const FilterLevels::Place place = levels.at(deviation);
    const auto squared = [&](std::size_t level) { return std::pow(levels.deviations()[level], 2); };
    const double next = place.share > 0.0 ? place.share * squared(place.level + 1) : 0.0;
    EXPECT_NEAR((1.0 - place.share) * squared(place.level) + next, deviation * deviation, 1e-12);
  }
  EXPECT_EQ(FilterLevels(0.3, 0.3).deviations(), std::vector{0.3});
}

TEST(BakeTextures, CountsTheFrequenciesOfLayers) {
  const Sheet sheet = square(2.0);
  BakeRecipe recipe = recipe_of(2.0);
  recipe.layers = {Layer{}};
  const double own = cycles_per_texel(plan(sheet, recipe));
  recipe.layers.push_back({.noise = NoiseRecipe{GaborNoiseOptions{.frequency = 16.0}, {}}});
  EXPECT_NEAR(cycles_per_texel(plan(sheet, recipe)), 8.0 * own, 0.3 * own);
}

TEST(BakeTextures, NamesMapsOfTheRecipe) {
  BakeRecipe recipe;
  recipe.properties["roughness"] = {.use = "value"};
  EXPECT_EQ(texture_map("height", recipe).property, "");
  EXPECT_EQ(texture_map("roughness", recipe).property, "roughness");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { texture_map("gloss", recipe); }),
            "map is gloss; with this recipe it must be one of color, normal, height, noise, roughness");
}

}  // namespace
}  // namespace solidnoise::bake_textures_test
