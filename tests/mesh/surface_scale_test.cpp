// Scale belongs to the asset, not to its tessellation: frequencies, steering and tangent planes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "support/paths.h"
#include "support/surfaces.h"

namespace solidnoise::surface_scale_test {
namespace {

PolygonMesh wyrm() {
  return read_mesh(in_source("meshes/wyrm.ply")).mesh;
}

// E[(noise(x + d) - noise(x))^2] on a plane, by the spectrum S of the noise of frequency 1:
// 2 integral of 2 pi f S(f) (1 - J0(2 pi f d)) df.
double expected_square(const GaborNoise<2>& noise, double distance) {
  constexpr double kHighest = 4.0;
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double f = kHighest * (i + 0.5) / kSteps;
    const double turns = 2.0 * std::numbers::pi * f;
    sum += 2.0 * turns * noise.power_spectrum({f, 0.0}) * (1.0 - std::cyl_bessel_j(0, turns * distance));
  }
  return sum * kHighest / kSteps;
}

constexpr double kFarthest = 1.0;  // wavelengths

// The same of the recipe's noise, an edge's length in wavelengths. Of oriented noise it is the mean over the
// edge's directions: along the waves' fronts next to nothing changes but where they turn.
std::function<double(double)> expected_square(const BakeRecipe& recipe) {
  const double bandwidth = recipe.bandwidth.from;
  if (recipe.noise.kind == SurfaceNoiseKind::oriented) {
    const OrientedGaborNoise<2> noise(
        {.frequency = 1.0, .bandwidth = bandwidth, .error = recipe.noise.error, .anisotropy = 1.0});
    return [waves = noise.waves()](double length) {
      constexpr int kTurns = 16;
      double sum = 0.0;
      for (int i = 0; i < kTurns; ++i) {
        const double turn = std::numbers::pi * i / kTurns;
        sum += waves.variance() - waves.covariance(length * Vec<2>(std::cos(turn), std::sin(turn)));
      }
      return 2.0 * sum / kTurns;
    };
  }
  const GaborNoise<2> noise({.frequency = 1.0, .bandwidth = bandwidth, .error = recipe.noise.error});
  constexpr std::size_t kTable = 256;
  std::vector<double> table;
  for (std::size_t i = 0; i <= kTable; ++i) {
    table.push_back(expected_square(noise, kFarthest * static_cast<double>(i) / kTable));
  }
  return [table](double length) {
    const double place = length / kFarthest * kTable;
    const auto i = static_cast<std::size_t>(place);
    return table[i] + (place - static_cast<double>(i)) * (table[i + 1] - table[i]);
  };
}

// What the noise does along the edges of a mesh, against what it does on a plane.
struct EdgeSteps {
  double torn = 0.0;      // share of the edges where it steps by more than 3.5 standard deviations, those of
                          // edges that lie along the waves
  double gradient = 0.0;  // root mean square of the steps, in standard deviations
};

EdgeSteps measure_steps(const BakePlan& plan, const BakeRecipe& recipe) {
  const BakedMesh baked = bake(plan, recipe);
  const std::vector<double>& values = baked.mesh.property("noise")->values;
  const auto expected = expected_square(recipe);
  const double along = recipe.noise.kind == SurfaceNoiseKind::oriented ? 2.0 : 1.0;  // over the mean square
  const VertexNumber& frequency = plan.parameters.frequency;
  const auto frequency_at = [&](std::uint32_t v) {
    return frequency.varies() ? static_cast<double>(frequency.values[v]) : frequency.constant;
  };
  EdgeSteps steps;
  double count = 0.0;
  for (std::size_t f = 0; f < plan.mesh.face_count(); ++f) {
    const auto face = plan.mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k];
      const std::uint32_t b = face[(k + 1) % face.size()];
      const double length = glm::distance(plan.mesh.positions[a], plan.mesh.positions[b]) *
                            std::sqrt(frequency_at(a) * frequency_at(b));
      if (length <= 0.0 || length >= kFarthest) continue;
      const double square = expected(length);
      const double step = values[b] - values[a];
      steps.torn += step * step > 3.5 * 3.5 * along * square ? 1.0 : 0.0;
      steps.gradient += step * step / square;
      count += 1.0;
    }
  }
  return {steps.torn / count, std::sqrt(steps.gradient / count)};
}

// Bumps of a tenth of a feature and less, such as scanned skin has.
PolygonMesh rough_wyrm() {
  PolygonMesh mesh = wyrm();
  return shaken(std::move(mesh), 1e-3);
}

BakeRecipe narrow_band() {
  BakeRecipe recipe;
  recipe.noise.error = 0.05;
  recipe.bandwidth = {0.6, 0.6};
  return recipe;
}

BakeRecipe following_curvature(BakeRecipe recipe) {
  recipe.detail = {0.6, 2.2};
  recipe.by.source = SteeringSource::abs_curvature;
  return recipe;
}

// Whether it keeps one frequency, or follows the curvature.
void expect_no_tears(const BakeRecipe& recipe, double steady_gradient) {
  for (const PolygonMesh& mesh : {wyrm(), rough_wyrm()}) {
    const EdgeSteps steady = measure_steps(plan_bake(mesh, recipe), recipe);
    EXPECT_LT(steady.torn, 0.01);
    EXPECT_LT(steady.gradient, steady_gradient);
    const BakeRecipe varying = following_curvature(recipe);
    const EdgeSteps steered = measure_steps(plan_bake(mesh, varying), varying);
    EXPECT_LT(steered.torn, 0.01);
    EXPECT_LT(steered.gradient, 1.3);
  }
}

TEST(SurfaceScale, NoiseDoesNotTearWhereItFollowsTheCurvatureOfAnyMesh) {
  expect_no_tears(narrow_band(), 1.1);
  // What smoothing is for.
  BakeRecipe rough = following_curvature(narrow_band());
  rough.smooth = 0;
  rough.smooth_radius = 0.0;
  const EdgeSteps raw = measure_steps(plan_bake(rough_wyrm(), rough), rough);
  EXPECT_GT(raw.torn, 0.01);
  EXPECT_GT(raw.gradient, 1.5);
}

TEST(SurfaceScale, OrientedNoiseDoesNotTear) {
  BakeRecipe recipe = narrow_band();
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  for (const auto source : {DirectionRecipe::Source::axis, DirectionRecipe::Source::max_curvature}) {
    recipe.direction.source = source;
    expect_no_tears(recipe, 1.1);
  }
}

// The noise of `scales`, whose waves are narrower and follow the curvature over more.
TEST(SurfaceScale, ScalesDoNotTear) {
  BakeRecipe recipe = narrow_band();
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.bandwidth = {0.5, 0.5};
  recipe.detail = {1.6, 4.5};
  recipe.by.source = SteeringSource::abs_curvature;
  for (const PolygonMesh& mesh : {wyrm(), rough_wyrm()}) {
    const EdgeSteps steps = measure_steps(plan_bake(mesh, recipe), recipe);
    EXPECT_LT(steps.torn, 0.01);
    EXPECT_LT(steps.gradient, 1.3);
  }
}

// An axis laid into a sphere comes to its poles from all sides. Neighbours there are a fiftieth of a
// wavelength apart, and of waves that turned around the pole would differ by as much as any two places.
TEST(SurfaceScale, OrientedNoiseHasOneValueWhereDirectionsTurn) {
  const PolygonMesh sphere = sphere_mesh(1.0, {.n = 120});
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.frequency = ParameterRange{1.5, 1.5};
  recipe.direction.axis = Vec<3>(0.0, 0.0, 1.0);
  std::vector<std::size_t> at_pole;
  for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
    if (glm::distance(sphere.positions[v], Vec<3>(0.0, 0.0, 1.0)) < 0.02) at_pole.push_back(v);
  }
  ASSERT_GE(at_pole.size(), 9u);
  const auto largest_difference = [&] {
    const BakePlan plan = plan_bake(sphere, recipe);
    double largest = 0.0;
    for (recipe.noise.seed = 1; recipe.noise.seed <= 10; ++recipe.noise.seed) {
      const BakedMesh baked = bake(plan, recipe);
      const std::vector<double>& values = baked.mesh.property("noise")->values;
      const auto by_value = [&](std::size_t a, std::size_t b) { return values[a] < values[b]; };
      const auto [least, most] = std::minmax_element(at_pole.begin(), at_pole.end(), by_value);
      largest = std::max(largest, values[*most] - values[*least]);
    }
    return largest;
  };
  EXPECT_LT(largest_difference(), 0.5);
  recipe.smooth_radius = 0.0;
  EXPECT_GT(largest_difference(), 1.5);
}

// Of a plane whose points are up to an edge's length above and below it.
TEST(SurfaceScale, RoughSurfacesKeepTheirDirections) {
  constexpr int kSide = 60;
  PolygonMesh mesh = grid_mesh(kSide, kSide, {Ends::open, Ends::open}, {},
                               [](double u, double v) { return Vec<3>(u, 0.0, v); });
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> height(-1.0 / kSide, 1.0 / kSide);
  for (Vec<3>& position : mesh.positions) position.y = height(engine);
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.frequency = ParameterRange{4.0, 4.0};
  recipe.direction.axis = Vec<3>(1.0, 0.0, 0.0);
  std::vector<double> lengths;
  for (const Vec<3>& direction : plan_bake(mesh, recipe).guides.directions)
    lengths.push_back(glm::length(direction));
  std::sort(lengths.begin(), lengths.end());
  EXPECT_GT(lengths[lengths.size() / 10], 0.99);
}

// They lie in the planes that the file says, where there are no faces to tell.
TEST(SurfaceScale, PointsWithoutFacesHaveTheAxisForADirection) {
  PolygonMesh cloud;
  cloud.positions = sphere_mesh(1.0, {.n = 8}).positions;
  for (int axis = 0; axis < 3; ++axis) {
    VertexProperty normal{std::string("n") + "xyz" [axis], ScalarType::float64, {}};
    for (const Vec<3>& position : cloud.positions) normal.values.push_back(position[axis]);
    cloud.properties.push_back(normal);
  }
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.frequency = ParameterRange{4.0, 4.0};
  recipe.direction.axis = Vec<3>(0.3, 1.0, 0.2);
  const BakePlan plan = plan_bake(cloud, recipe);
  for (std::size_t v = 0; v < cloud.positions.size(); ++v) {
    const Vec<3>& direction = plan.guides.directions[v];
    EXPECT_NEAR(glm::length(direction), 1.0, 1e-6);
    EXPECT_NEAR(glm::dot(direction, cloud.positions[v]), 0.0, 1e-6);
  }
}

TEST(SurfaceScale, PointsAloneAreNeitherRefinedNorMovedInDirectionsThatNobodySaid) {
  PolygonMesh cloud;
  cloud.positions = sphere_mesh(1.0, {.n = 8}).positions;
  BakeRecipe recipe;
  recipe.displace = 0.1;
  EXPECT_THROW(plan_bake(cloud, recipe), std::invalid_argument);
  recipe.displace = 0.0;
  EXPECT_NO_THROW(plan_bake(cloud, recipe));
  recipe.refine.mode = RefineRecipe::Mode::automatic;
  EXPECT_THROW(plan_bake(cloud, recipe), std::invalid_argument);
}

TEST(SurfaceScale, FrequenciesDoNotDependOnTheTessellation) {
  const BakeRecipe recipe;
  const double coarse = plan_bake(torus_mesh(1.0, 0.4, {.n = 8}), recipe).parameters.frequency.constant;
  const double fine = plan_bake(torus_mesh(1.0, 0.4, {.n = 64}), recipe).parameters.frequency.constant;
  EXPECT_NEAR(coarse, fine, 1e-9 * fine);
}

// In metres or in centimetres: values are the same but for rounding.
TEST(SurfaceScale, PatternsDoNotDependOnTheUnitOfLength) {
  PolygonMesh mesh = wyrm();
  PolygonMesh in_centimetres = mesh;
  for (Vec<3>& position : in_centimetres.positions) position *= 100.0;
  for (const auto kind : {SurfaceNoiseKind::surface, SurfaceNoiseKind::oriented, SurfaceNoiseKind::solid,
                          SurfaceNoiseKind::kensler}) {
    BakeRecipe recipe = following_curvature({});
    recipe.noise.kind = kind;
    const BakedMesh baked = bake(plan_bake(mesh, recipe), recipe);
    const BakedMesh scaled = bake(plan_bake(in_centimetres, recipe), recipe);
    const std::vector<double>& values = baked.mesh.property("noise")->values;
    const std::vector<double>& others = scaled.mesh.property("noise")->values;
    double squares = 0.0;
    for (std::size_t v = 0; v < values.size(); ++v) squares += std::pow(values[v] - others[v], 2);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(values.size())), 1e-3) << static_cast<int>(kind);
  }
}

TEST(SurfaceScale, VerticesAreCountedBeforeTheyAreMade) {
  const PolygonMesh mesh = torus_mesh(1.0, 0.4, {.n = 12, .jitter = 0.3});
  for (const double target : {1.0, 0.11, 0.02}) {
    const double counted = refined_vertices(mesh, std::array{target}, {}, 1e9);
    EXPECT_EQ(counted, static_cast<double>(refine(mesh, std::array{target}).mesh.positions.size()));
  }
  EXPECT_TRUE(std::isinf(refined_vertices(mesh, std::array{0.02}, {}, 1000.0)));
  EXPECT_TRUE(std::isinf(refined_vertices(mesh, std::array{1e-300}, {}, 1e6)));
}

// Edges half as long take four times the vertices.
TEST(SurfaceScale, RefiningShowsTheNoisesOfLayers) {
  const PolygonMesh mesh = torus_mesh(1.0, 0.4, {.n = 24});
  BakeRecipe recipe;
  recipe.frequency = ParameterRange{2.0, 2.0};
  recipe.refine = {.mode = RefineRecipe::Mode::automatic, .budget = 1000000};
  recipe.layers = {Layer{}};
  const auto vertices = [&] { return static_cast<double>(plan_bake(mesh, recipe).mesh.positions.size()); };
  const double own = vertices();
  recipe.layers.push_back({.noise = NoiseRecipe{GaborNoiseOptions{.frequency = 8.0}, {}}});
  const double fine = vertices();
  EXPECT_NEAR(fine / own, 16.0, 4.0);
  recipe.layer_unit = LayerUnit::feature;
  recipe.layers[1].noise =
      NoiseRecipe{GaborNoiseOptions{.frequency = 8.0 * plan_bake(mesh, recipe).feature_size}, {}};
  EXPECT_EQ(vertices(), fine);
}

TEST(SurfaceScale, RefiningStaysWithinItsBudget) {
  BakeRecipe recipe;
  recipe.noise.fractal.octaves = 4;
  recipe.refine.mode = RefineRecipe::Mode::automatic;
  recipe.refine.budget = 20000;
  const PolygonMesh mesh = torus_mesh(1.0, 0.4, {.n = 20, .jitter = 0.3});
  const BakePlan plan = plan_bake(mesh, recipe);
  EXPECT_LE(plan.mesh.positions.size(), 20000u);
  EXPECT_GT(plan.mesh.positions.size(), 10000u);
  EXPECT_GT(plan.mean_cycles_per_edge, kHighestCyclesPerEdge);
  EXPECT_GT(plan.vertices_to_show, 5e4);
  // What is said to be needed is what it takes.
  recipe.refine.budget = 10'000'000;
  const BakePlan all = plan_bake(mesh, recipe);
  EXPECT_EQ(static_cast<double>(all.mesh.positions.size()), plan.vertices_to_show);
  EXPECT_LE(all.mean_cycles_per_edge, kHighestCyclesPerEdge);
}

}  // namespace
}  // namespace solidnoise::surface_scale_test
