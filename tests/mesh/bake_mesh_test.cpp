#include "solidnoise/mesh/bake_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/image/color.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "support/message_of.h"
#include "support/spectra.h"
#include "support/surfaces.h"

namespace solidnoise::bake_mesh_test {
namespace {

// Bent differently everywhere, with a number per vertex of its own.
PolygonMesh test_mesh() {
  PolygonMesh mesh = torus_mesh(1.0, 0.4, {.n = 24});
  std::vector<double> heat(mesh.positions.size());
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] = static_cast<double>(i);
  mesh.properties.push_back({"heat", ScalarType::float64, heat});
  mesh.properties.push_back({"nx", ScalarType::float32, std::vector<double>(heat.size(), 1.0)});
  mesh.properties.push_back({"ny", ScalarType::float32, std::vector<double>(heat.size(), 0.0)});
  mesh.properties.push_back({"nz", ScalarType::float32, std::vector<double>(heat.size(), 0.0)});
  return mesh;
}

BakedMesh bake_all(const PolygonMesh& mesh, const BakeRecipe& recipe,
                   const std::vector<std::string>& keep = {}) {
  return bake(plan_bake(mesh, recipe), recipe, keep);
}

TEST(BakeMesh, KeepsTheMeshAndAddsColorsAndValues) {
  const PolygonMesh mesh = test_mesh();
  const BakeRecipe recipe;
  const BakedMesh baked = bake_all(mesh, recipe);
  EXPECT_EQ(baked.mesh.positions, mesh.positions);
  EXPECT_EQ(baked.mesh.corners, mesh.corners);
  ASSERT_EQ(baked.mesh.properties.size(), 4u + 4u + 1u);
  EXPECT_EQ(baked.mesh.properties[0].name, "heat");
  EXPECT_EQ(baked.mesh.properties[0].values, mesh.properties[0].values);
  EXPECT_EQ(baked.mesh.property("noise")->type, ScalarType::float32);
  EXPECT_EQ(baked.mesh.property("red")->type, ScalarType::uint8);
}

TEST(BakeMesh, KeepsGradientsAndCurlsForRenderers) {
  BakeRecipe recipe;
  recipe.properties["height"] = {.use = "value", .weight = 3.0};
  recipe.smooth_radius = 0.0;  // the noise lies in the surface's own planes
  const PolygonMesh mesh = test_mesh();
  const BakePlan plan = plan_bake(mesh, recipe);
  const BakedMesh baked = bake(plan, recipe, {"gradient", "curl"});
  const auto vector = [&](const std::string& name, std::size_t v) {
    return Vec<3>(baked.mesh.property(name + "_x")->values[v], baked.mesh.property(name + "_y")->values[v],
                  baked.mesh.property(name + "_z")->values[v]);
  };
  constexpr double kStep = 1e-3;  // world units: of a wave of a tenth
  for (std::size_t v = 0; v < mesh.positions.size(); v += 97) {
    const Vec<3> gradient = vector("gradient", v);
    const Vec<3> normal = plan.guides.normals[v];
    const double length = glm::length(gradient);
    EXPECT_LT(std::abs(glm::dot(gradient, normal)), 1e-5 * length);
    EXPECT_LT(glm::length(glm::cross(normal, gradient) - vector("curl", v)), 1e-5 * length);
    // The height a step further along the surface, of a plan whose vertex is there.
    BakePlan moved = plan;
    moved.mesh.positions[v] += kStep / length * gradient;
    const double there = bake(moved, recipe).mesh.property("height")->values[v];
    moved.mesh.positions[v] = plan.mesh.positions[v] - kStep / length * gradient;
    const double here = bake(moved, recipe).mesh.property("height")->values[v];
    EXPECT_NEAR((there - here) / (2.0 * kStep), length, 0.02 * length + 0.05);
  }
}

// Relative to its own root mean square, against that of kernels of a fiftieth of the error at the same
// impulses. Kernels have three quarters of the error's square, .87 of it; those for values have 1.15 to 1.54.
TEST(BakeMesh, GradientIsWithinTheErrorAsValuesAre) {
  constexpr double kError = 0.05;
  for (const SurfaceNoiseKind kind : {SurfaceNoiseKind::surface, SurfaceNoiseKind::oriented,
                                      SurfaceNoiseKind::solid, SurfaceNoiseKind::spectrum}) {
    SCOPED_TRACE(static_cast<int>(kind));
    BakeRecipe recipe;
    recipe.noise.kind = kind;
    recipe.frequency = ParameterRange{12.0, 12.0};
    if (kind == SurfaceNoiseKind::spectrum) recipe.noise.exemplar = some_spectrum(2).model;
    const auto gradient_within = [&](double error) {
      recipe.noise.error = error;
      const BakedMesh baked = bake_all(test_mesh(), recipe, {"gradient"});
      std::vector<double> components;
      for (const char* name : {"gradient_x", "gradient_y", "gradient_z"}) {
        const std::vector<double>& values = baked.mesh.property(name)->values;
        components.insert(components.end(), values.begin(), values.end());
      }
      return components;
    };
    const std::vector<double> made = gradient_within(kError);
    const std::vector<double> nearly_unlimited = gradient_within(0.001);
    double difference = 0.0;
    double power = 0.0;
    for (std::size_t i = 0; i < made.size(); ++i) {
      difference += squared(made[i] - nearly_unlimited[i]);
      power += squared(nearly_unlimited[i]);
    }
    EXPECT_LE(std::sqrt(difference / power), kError);
    EXPECT_GE(std::sqrt(difference / power), 0.4 * kError);
  }
}

TEST(BakeMesh, ColorsAreTheRampsAtTheValues) {
  BakeRecipe recipe;
  recipe.ramp = "viridis";
  recipe.contrast = 1.5;
  const BakedMesh baked = bake_all(test_mesh(), recipe);
  const ColorRamp ramp = parse_color_ramp("viridis");
  for (std::size_t i = 0; i < baked.mesh.positions.size(); ++i) {
    const double value = baked.mesh.property("noise")->values[i];
    const Color color = ramp.srgb(static_cast<float>(0.5 + 1.5 * value / 5.0));
    EXPECT_EQ(baked.mesh.property("green")->values[i], std::round(255.0 * color.g));
  }
}

// Two channels' colours along axes of their own, whose standard deviations follow from the spectra, around a
// mean; the third channel along an axis of length 0.
TEST(BakeMesh, ByExampleHasTheColorsOfTheExemplar) {
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::spectrum;
  GaborSpectrum spectrum = some_spectrum(2).model.channels[0];
  for (SpectrumComponent& component : spectrum.bands[0].components) component.variance *= 0.01;
  spectrum.bands[1].components[0].variance *= 0.01;
  recipe.noise.exemplar.channels = {spectrum, spectrum, spectrum};
  recipe.noise.exemplar.axes = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.5}, {0.0, 0.0, 0.0}};
  recipe.noise.exemplar.mean = {0.5, 0.4, 0.3};
  recipe.frequency = ParameterRange{40.0, 40.0};
  recipe.ramp = kExemplarRamp;
  const BakedMesh baked = bake_all(torus_mesh(1.0, 0.4, {.n = 60}), recipe);
  const double count = static_cast<double>(baked.colors.size());
  const auto covariance = [&](int a, int b) {
    double sum = 0.0;
    for (const Color& color : baked.colors) {
      sum += (color[a] - recipe.noise.exemplar.mean[a]) * (color[b] - recipe.noise.exemplar.mean[b]);
    }
    return sum / count;
  };
  // Vertices are a wavelength and more apart: samples about independent; 5 standard errors of a variance, of
  // sqrt(2.5 / count), and of a product of independent numbers, of sqrt(1 / count).
  const double tolerance = 5.0 * std::sqrt(2.5 / count);
  EXPECT_NEAR(covariance(0, 0) / 0.01, 1.0, tolerance);
  EXPECT_NEAR(covariance(1, 1) / 0.01, 1.0, tolerance);
  EXPECT_NEAR(covariance(1, 2) / 0.01, 0.5, tolerance);
  EXPECT_NEAR(covariance(0, 1) / 0.01, 0.0, tolerance);
  const double first = baked.mesh.property("noise")->values[7];
  EXPECT_NEAR(baked.colors[7].x, 0.5 + 0.1 * first, 1e-5);
}

TEST(BakeMesh, RangesFollowWhatTheyAreToldTo) {
  BakeRecipe recipe;
  recipe.frequency = ParameterRange{4.0, 16.0};
  recipe.by.source = SteeringSource::attribute;
  recipe.by.attribute = "heat";
  recipe.by.low_percentile = 0.0;
  recipe.by.high_percentile = 100.0;
  const BakePlan plan = plan_bake(test_mesh(), recipe);
  const std::size_t last = plan.mesh.positions.size() - 1;
  EXPECT_FLOAT_EQ(plan.parameters.frequency.values[0], 4.0f);
  EXPECT_FLOAT_EQ(plan.parameters.frequency.values[last], 16.0f);
  EXPECT_NEAR(plan.parameters.frequency.values[last / 2], 8.0f, 0.01f);

  recipe.by = Steering();
  recipe.by.source = SteeringSource::height;
  const BakePlan high = plan_bake(test_mesh(), recipe);
  for (std::size_t i = 1; i <= last; ++i) {
    if (high.mesh.positions[i].y <= high.mesh.positions[0].y) continue;
    EXPECT_GE(high.parameters.frequency.values[i], high.parameters.frequency.values[0]);
  }
}

// Noises of the tangent plane and parameters that follow the curvature are those of the surface, which has no
// seams: values differ by no more than their slope, at most some 2 pi standard deviations a cycle, times the
// 2e-7 that vertices are apart. A float's rounding is as much.
TEST(BakeMesh, DoesNotSeeSeams) {
  PolygonMesh mesh = seamed_sphere_mesh(1.0, 12);
  for (Vec<3>& p : mesh.positions) p *= Vec<3>(1.0, 1.3, 0.8);  // bent differently everywhere
  const PolygonMesh closed = with_closed_seams(mesh);
  const SurfaceMesh surface(closed);
  constexpr double kHighest = 2.0;
  const double tolerance = 10.0 * 2.0 * std::numbers::pi * kHighest * 2e-7;
  for (const SurfaceNoiseKind kind :
       {SurfaceNoiseKind::surface, SurfaceNoiseKind::oriented, SurfaceNoiseKind::kensler}) {
    BakeRecipe recipe;
    recipe.noise.kind = kind;
    recipe.frequency = ParameterRange{1.0, kHighest};
    recipe.magnitude = {0.5, 1.0};
    for (const auto mode : {RefineRecipe::Mode::off, RefineRecipe::Mode::rounds}) {
      recipe.refine.mode = mode;
      const PolygonMesh baked = bake_all(mesh, recipe).mesh;
      const PolygonMesh expected = bake_all(closed, recipe).mesh;
      ASSERT_EQ(baked.corners, expected.corners);
      EXPECT_TRUE(std::equal(mesh.positions.begin(), mesh.positions.end(), baked.positions.begin()));
      const std::vector<double>& values = baked.property("noise")->values;
      for (std::size_t v = 0; v < values.size(); ++v) {
        EXPECT_NEAR(values[v], expected.property("noise")->values[v], tolerance);
        if (v >= mesh.positions.size()) continue;
        EXPECT_NEAR(values[v], values[surface.vertex_at(surface.point_of(v))], tolerance);
      }
    }
  }
}

// The inside of a torus bends both ways, its outside only outwards.
TEST(BakeMesh, MeanCurvatureIsHighOutsideAndGaussianNegativeInside) {
  BakeRecipe recipe;
  recipe.bias = {0.0, 1.0};
  recipe.magnitude = {0.0, 0.0};
  for (const SteeringSource source : {SteeringSource::mean_curvature, SteeringSource::gaussian_curvature}) {
    recipe.by.source = source;
    const BakedMesh baked = bake_all(test_mesh(), recipe, {"steering"});
    double inner = 0.0;
    double outer = 0.0;
    double least = 1e9;
    double most = 0.0;
    for (std::size_t i = 0; i < baked.mesh.positions.size(); ++i) {
      const Vec<3>& p = baked.mesh.positions[i];
      const double distance = std::hypot(p.x, p.z);
      if (distance < least) inner = baked.mesh.property("noise")->values[i];
      if (distance > most) outer = baked.mesh.property("noise")->values[i];
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
    EXPECT_EQ(inner, 0.0);
    EXPECT_EQ(outer, 1.0);
  }
}

TEST(BakeMesh, DisplacesAlongTheNormalsBySamplesAtRest) {
  BakeRecipe recipe;
  const BakedMesh rest = bake_all(test_mesh(), recipe);
  recipe.displace = 0.02;
  const BakedMesh moved = bake_all(test_mesh(), recipe);
  EXPECT_EQ(moved.mesh.property("noise")->values, rest.mesh.property("noise")->values);
  for (std::size_t i = 0; i < rest.mesh.positions.size(); ++i) {
    const Vec<3> step = moved.mesh.positions[i] - rest.mesh.positions[i];
    const double value = rest.mesh.property("noise")->values[i];
    EXPECT_NEAR(glm::length(step - 0.02 * value * rest.normals[i]), 0.0, 1e-8);  // amounts are floats
    const Vec<3> stored(moved.mesh.property("nx")->values[i], moved.mesh.property("ny")->values[i],
                        moved.mesh.property("nz")->values[i]);
    EXPECT_NEAR(glm::length(stored), 1.0, 1e-9);
  }
}

// The faces of a mesh that was cut up are flat, its normals are not: moved by the same amount everywhere, a
// ball gets larger, and stays as round as it was.
TEST(BakeMesh, DisplacesRefinedMeshesAlongSmoothNormals) {
  BakeRecipe recipe;
  recipe.magnitude = {0.0, 0.0};
  recipe.bias = {1.0, 1.0};
  recipe.refine = {RefineRecipe::Mode::rounds, 2};
  const PolygonMesh ball = sphere_mesh(1.0, {.n = 8});
  const BakedMesh rest = bake_all(ball, recipe);
  recipe.displace = 0.5;
  const BakedMesh moved = bake_all(ball, recipe);
  for (std::size_t v = 0; v < rest.mesh.positions.size(); ++v) {
    const Vec<3> step = moved.mesh.positions[v] - rest.mesh.positions[v];
    // Edges span 0.2: flat faces turn their vertices' normals by half of that.
    EXPECT_GT(glm::dot(step, glm::normalize(rest.mesh.positions[v])), 0.5 * std::cos(0.03));
  }
}

TEST(BakeMesh, KeepsWhatItIsAskedToKeep) {
  BakeRecipe recipe;
  recipe.frequency = ParameterRange{4.0, 16.0};
  const BakedMesh baked = bake_all(test_mesh(), recipe, {"frequency", "weight", "steering"});
  for (const char* name : {"frequency", "weight", "steering"})
    EXPECT_NE(baked.mesh.property(name), nullptr) << name;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { bake_all(test_mesh(), recipe, {"weather"}); }),
            "keep is weather; it must be one of frequency, bandwidth, magnitude, bias, weight, steering, "
            "direction, gradient, curl");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { bake_all(test_mesh(), BakeRecipe(), {"weight"}); }),
            "keep is weight; there is none where no parameter is a range");
}

TEST(BakeMesh, NamesTheAttributesThatThereAre) {
  BakeRecipe recipe;
  recipe.frequency = ParameterRange{4.0, 16.0};
  recipe.by.source = SteeringSource::attribute;
  recipe.by.attribute = "cold";
  EXPECT_EQ(message_of<std::invalid_argument>([&] { plan_bake(test_mesh(), recipe); }),
            "attribute is cold; the vertices have heat, nx, ny, nz");
}

TEST(BakeMesh, EveryFiniteVertexGetsAValue) {
  PolygonMesh mesh;  // one triangle twice, one degenerate, an edge of length 0, a vertex by itself
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {5, 5, 5}};
  mesh.add_face(std::vector<std::uint32_t>{0, 1, 2});
  mesh.add_face(std::vector<std::uint32_t>{0, 1, 2});
  mesh.add_face(std::vector<std::uint32_t>{0, 0, 1});
  mesh.add_face(std::vector<std::uint32_t>{1, 2, 3});
  for (const SurfaceNoiseKind kind :
       {SurfaceNoiseKind::surface, SurfaceNoiseKind::solid, SurfaceNoiseKind::kensler}) {
    BakeRecipe recipe;
    recipe.noise.kind = kind;
    if (kind != SurfaceNoiseKind::kensler) recipe.frequency = ParameterRange{1.0, 4.0};
    const BakedMesh baked = bake_all(mesh, recipe);
    for (const double value : baked.mesh.property("noise")->values) EXPECT_TRUE(std::isfinite(value));
  }
}

// Of a torus in space, of which layers and noise are of the same size, whatever its own: all lengths change
// by a power of 2.
TEST(BakeMesh, LayersInFeaturesAreOfTheMeshesSize) {
  BakeRecipe recipe;
  recipe.layers = {{},
                   {.noise = NoiseRecipe{GaborNoiseOptions{.frequency = 0.7}, {}},
                    .warp = Warp{0.3, NoiseRecipe{GaborNoiseOptions{.frequency = 1.0}, {}}}}};
  recipe.layer_unit = LayerUnit::feature;
  recipe.smooth_radius = 0.0;
  PolygonMesh mesh = test_mesh();
  const auto small = bake_all(mesh, recipe).mesh.property("noise")->values;
  for (Vec<3>& position : mesh.positions) position *= 8.0;
  EXPECT_EQ(bake_all(mesh, recipe).mesh.property("noise")->values, small);
  recipe.layer_unit = LayerUnit::world;
  EXPECT_NE(bake_all(mesh, recipe).mesh.property("noise")->values, small);
}

TEST(BakeMesh, HasTheRecipesPropertiesAndIsDisplacedByTheHeight) {
  BakeRecipe recipe;
  recipe.magnitude = {0.5, 0.5};
  recipe.bias = {0.25, 0.25};
  recipe.properties = {{"roughness", {.use = "value", .weight = 0.1, .bias = 0.5}},
                       {"height", {.use = "value", .ramp = {{0.0, 1.0}, {0.5, 3.0}}}},
                       {"wear", {.place = Layer::Place::weight}}};
  recipe.displace = 0.125;
  const BakePlan plan = plan_bake(test_mesh(), recipe);
  const BakedMesh baked = bake(plan, recipe);
  for (std::size_t i = 0; i < plan.mesh.positions.size(); ++i) {
    const auto number = [&](const char* name) { return baked.mesh.property(name)->values[i]; };
    const double value = number("noise");
    EXPECT_FLOAT_EQ(static_cast<float>(number("roughness")), static_cast<float>(0.1 * value + 0.5));
    EXPECT_FLOAT_EQ(static_cast<float>(number("height")),
                    static_cast<float>(1.0 + 4.0 * std::clamp(value, 0.0, 0.5)));
    EXPECT_EQ(number("wear"), plan.guides.steering.weights[i]);
    const Vec<3> moved = plan.mesh.positions[i] + 0.125 * number("height") * plan.guides.normals[i];
    EXPECT_LT(glm::length(baked.mesh.positions[i] - moved), 1e-6);
  }
}

// Asked often, and between all steps: at whichever it is told to, it stops.
TEST(BakeMesh, PlansStopWhereTheyAreAskedTo) {
  class StopAt final : public Progress {
   public:
    explicit StopAt(int last) : last_(last) {}
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return asked_++ >= last_; }
    int asked() const { return asked_; }

   private:
    int last_;
    std::atomic<int> asked_{0};
  };
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.smooth_radius = 1.0;
  recipe.frequency = {4.0, 8.0};
  recipe.refine = {.mode = RefineRecipe::Mode::rounds, .rounds = 2};
  StopAt never(std::numeric_limits<int>::max());
  plan_bake(test_mesh(), recipe, &never);
  EXPECT_GT(never.asked(), 15);
  for (int last = 0; last < never.asked(); ++last) {
    StopAt stop(last);
    EXPECT_THROW(plan_bake(test_mesh(), recipe, &stop), Cancelled) << last;
  }
}

}  // namespace
}  // namespace solidnoise::bake_mesh_test
