// Noise by example on a mesh: which way up a photograph stands.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/mesh/bake_mesh.h"
#include "support/surfaces.h"

namespace solidnoise::example_on_surface_test {
namespace {

constexpr int kSide = 48;
constexpr double kStep = 0.05;

// A noise that is nearly one wave, of one cycle per unit along `wave` in the photograph.
BakeRecipe wave_recipe(const Vec<2>& wave) {
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::spectrum;
  GaborSpectrum spectrum;
  spectrum.bands = {{0.2, {{{wave.x, wave.y, 0.0}, 1.0}}}};
  recipe.noise.exemplar.channels = {spectrum};
  recipe.frequency = ParameterRange{1.0, 1.0};
  return recipe;
}

// A wall that faces +z, seen with x to the right and y up; or, with z up, one that faces -y.
PolygonMesh wall(UpAxis up) {
  return grid_mesh(kSide, kSide, {Ends::open, Ends::open}, {}, [&](double u, double v) {
    const double right = kSide * kStep * u;
    const double height = kSide * kStep * v;
    return up == UpAxis::y ? Vec<3>(right, height, 0.0) : Vec<3>(right, 0.0, height);
  });
}

// Mean square of what the values of rows 0 to `rows` change by over (right, up) squares.
double change(const std::vector<double>& values, int right, int up, int rows = kSide) {
  double sum = 0.0;
  int count = 0;
  for (int j = std::max(0, -up); j + std::max(0, up) <= rows; ++j) {
    for (int i = std::max(0, -right); i + std::max(0, right) <= kSide; ++i) {
      const double d = values[static_cast<std::size_t>((j + up) * (kSide + 1) + i + right)] -
                       values[static_cast<std::size_t>(j * (kSide + 1) + i)];
      sum += d * d;
      ++count;
    }
  }
  return sum / count;
}

std::vector<double> baked(const BakeRecipe& recipe) {
  return bake(plan_bake(wall(recipe.up), recipe), recipe).mesh.property("noise")->values;
}

// Along the wave a quarter of a cycle changes values by sigma sqrt2; across it, only by the band's width.
TEST(ExampleOnSurface, APhotographStandsUpright) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    BakeRecipe recipe = wave_recipe({0.0, 1.0});
    recipe.up = up;
    const std::vector<double> values = baked(recipe);
    EXPECT_GT(change(values, 0, 5), 10.0 * change(values, 5, 0));
  }
  const std::vector<double> sideways = baked(wave_recipe({1.0, 0.0}));
  EXPECT_GT(change(sideways, 5, 0), 10.0 * change(sideways, 0, 5));
}

TEST(ExampleOnSurface, APhotographIsNotMirrored) {
  const std::vector<double> values =
      baked(wave_recipe({std::numbers::sqrt2 / 2.0, std::numbers::sqrt2 / 2.0}));
  EXPECT_GT(change(values, 4, 4), 10.0 * change(values, 4, -4));
}

TEST(ExampleOnSurface, ADirectionTurnsThePhotograph) {
  BakeRecipe recipe = wave_recipe({0.0, 1.0});
  recipe.direction.axis = Vec<3>(1.0, 0.0, 0.0);
  const std::vector<double> values = baked(recipe);
  EXPECT_GT(change(values, 5, 0), 10.0 * change(values, 0, 5));
}

// Four cycles at the top for one at the bottom: values change by (2 pi f step)^2 from one square to the next,
// some 14 times as much. Half of that leaves room for the few waves that rows have.
TEST(ExampleOnSurface, ItsFrequencyMayFollowTheSurface) {
  BakeRecipe recipe = wave_recipe({1.0, 0.0});
  recipe.frequency = ParameterRange{1.0, 4.0};
  recipe.by.source = SteeringSource::height;
  const std::vector<double> values = baked(recipe);
  const auto change_in_rows = [&](int first) {
    const auto row = values.begin() + first * (kSide + 1);
    return change({row, row + 8 * (kSide + 1)}, 1, 0, 7);
  };
  EXPECT_GT(change_in_rows(kSide + 1 - 8), 7.0 * change_in_rows(0));
}

}  // namespace
}  // namespace solidnoise::example_on_surface_test
