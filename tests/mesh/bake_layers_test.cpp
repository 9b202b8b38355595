// Layers on surfaces: the noise of the surface and solid noises, by the same tree as in volumes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/message_of.h"

namespace solidnoise::bake_layers_test {
namespace {

// Points all over a sphere of radius 1, their own normals.
std::vector<Vec<3>> sphere_points() {
  std::vector<Vec<3>> points;
  for (int i = 0; i < 2000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 2000.0;
    const double angle = 2.399963229728653 * i;
    points.emplace_back(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle),
                        z);
  }
  return points;
}

struct Sphere {
  std::vector<Vec<3>> positions = sphere_points();
  BakeVertices vertices;

  Sphere() {
    vertices.positions = positions;
    vertices.normals = positions;
    for (const Vec<3>& p : positions)
      vertices.frequency.values.push_back(static_cast<float>(5.0 + 2.0 * p.y));
  }
};

SurfaceNoiseRecipe some_surface() {
  SurfaceNoiseRecipe recipe;
  recipe.fractal.octaves = 3;
  recipe.seed = 9;
  return recipe;
}

NoiseRecipe coarse() {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.5, .seed = 4}, {}};
  return recipe;
}

TEST(BakeLayers, ALayerThatChangesNothingIsTheNoiseBitForBit) {
  const Sphere sphere;
  EXPECT_EQ(bake_layers(some_surface(), {.layers = {Layer{}}}, sphere.vertices).values,
            bake_noise(some_surface(), sphere.vertices));
}

TEST(BakeLayers, OfANoiseOfTheirOwnAreTheSolidNoise) {
  const Sphere sphere;
  const auto baked =
      bake_layers(some_surface(), {.layers = {{.noise = coarse(), .bias = 0.5}}}, sphere.vertices).values;
  const auto noise = make_noise<3>(noise_of_layer(coarse(), noise_of_layers(some_surface())));
  std::vector<float> expected(baked.size());
  noise->evaluate(Points<3>{sphere.positions}, {expected, {}});
  for (std::size_t i = 0; i < baked.size(); ++i) ASSERT_EQ(baked[i], expected[i] + 0.5f);
}

TEST(BakeLayers, MixTangentAndSolidNoises) {
  const Sphere sphere;
  const Layer ridged{.fold = Layer::Fold::ridged};
  const Layer solid{.noise = coarse()};
  const Layer height{.place = Layer::Place::height, .ramp = {{0.4, 0.0}, {0.6, 1.0}}};
  const auto of = [&](const Layer& layer) {
    return bake_layers(some_surface(), {.layers = {layer}}, sphere.vertices).values;
  };
  const auto mixed = of({.layers = {ridged, solid, height}, .combine = Layer::Combine::mix});
  const auto below = of(ridged);
  const auto above = of(solid);
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (sphere.positions[i].y < -0.21) {
      EXPECT_EQ(mixed[i], below[i]);
    } else if (sphere.positions[i].y > 0.21) {
      EXPECT_NEAR(mixed[i], above[i], 1e-6);
    }
  }
}

TEST(BakeLayers, AreRefusedWhereTheyCannotBe) {
  BakeRecipe recipe;
  recipe.layers = {{.use = "paint"}};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "layers[0].use is paint; it must be left out where there are no fields");
  const Sphere sphere;
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              bake_layers(some_surface(), {.layers = {{.stretch = {1.0, 2.0, 1.0}}}}, sphere.vertices).values;
            }),
            "stretch differs from axis to axis in layers with solid noises of their own only");
  EXPECT_EQ(message_of<std::invalid_argument>(
                [&] { bake_layers(some_surface(), {.layers = {{.turn = 90.0}}}, sphere.vertices).values; }),
            "turn applies to layers of a noise that has a direction: oriented, or a flat exemplar");
  recipe.layers = {{.noise = coarse(), .turn = 90.0}};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { recipe.validate(); }),
            "layers[0].turn has no effect but on a surface's oriented noise");
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              validate_layers({{.place = Layer::Place::weight}}, {coarse(), {}});
            }),
            "layers[0].place is weight; only the noise of a surface is steered");
}

// Three times as long, three times as slow, at all vertices.
TEST(BakeLayers, OfTheSurfacesNoiseStretchAlike) {
  Sphere sphere;
  const auto stretched =
      bake_layers(some_surface(), {.layers = {{.stretch = Vec<3>(4.0)}}}, sphere.vertices).values;
  for (float& frequency : sphere.vertices.frequency.values) frequency /= 4.0f;
  EXPECT_EQ(stretched, bake_noise(some_surface(), sphere.vertices));
}

TEST(BakeLayers, TurnTheDirectionsOfOrientedNoise) {
  Sphere sphere;
  SurfaceNoiseRecipe oriented = some_surface();
  oriented.kind = SurfaceNoiseKind::oriented;
  std::vector<Vec<3>> north;
  std::vector<Vec<3>> west;
  for (const Vec<3>& p : sphere.positions) {
    north.push_back(glm::normalize(Vec<3>(0.0, 1.0, 0.0) - p.y * p));
    west.push_back(glm::cross(p, north.back()));  // north turned by a right angle, as seen from outside
  }
  sphere.vertices.directions = north;
  const auto turned = bake_layers(oriented, {.layers = {{.turn = 90.0}}}, sphere.vertices).values;
  sphere.vertices.directions = west;
  const auto expected = bake_noise(oriented, sphere.vertices);
  // Directions in single precision, of waves some 10 of which reach a vertex.
  for (std::size_t i = 0; i < turned.size(); ++i) EXPECT_NEAR(turned[i], expected[i], 1e-4);
}

TEST(BakeLayers, UseNamedFieldsAndWeights_PropertiesTheValueToo) {
  Sphere sphere;
  std::vector<float> weights;
  for (const Vec<3>& p : sphere.positions) weights.push_back(static_cast<float>(0.5 + 0.5 * p.x));
  sphere.vertices.weights = weights;
  sphere.vertices.magnitude.constant = 3.0;
  const SurfaceLayers layers{.layers = {{.use = "steered"}},
                             .fields = {{"steered", {.place = Layer::Place::weight, .weight = 2.0}}},
                             .properties = {{.layers = {{.use = "steered"}, {.use = "value", .weight = 0.5}},
                                             .combine = Layer::Combine::sum}}};
  const BakedLayers baked = bake_layers(some_surface(), layers, sphere.vertices);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_EQ(baked.values[i], 6.0f * weights[i]);
    EXPECT_EQ(baked.properties.front()[i], 2.0f * weights[i] + 0.5f * baked.values[i]);
  }
}

}  // namespace
}  // namespace solidnoise::bake_layers_test
