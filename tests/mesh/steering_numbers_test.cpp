#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/vertex_parameters.h"
#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::steering_numbers_test {
namespace {

// Two vertices: one on a ridge that also bends the other way, one in a crease.
const Curvature kCurvature{{3.0, 1.0}, {-1.0, -5.0}, {}, {}};

PolygonMesh two_vertices() {
  PolygonMesh mesh;
  mesh.positions = {{1, 2, 3}, {4, 5, 6}};
  mesh.properties = {{"quality", ScalarType::float32, {0.25, 0.75}}, {"red", ScalarType::uint8, {7, 8}}};
  return mesh;
}

std::vector<double> numbers(SteeringSource source) {
  return steering_numbers(two_vertices(), kCurvature, {.source = source}, UpAxis::y);
}

TEST(SteeringNumbers, AreTheSourceAtEachVertex) {
  EXPECT_EQ(numbers(SteeringSource::mean_curvature), (std::vector{1.0, -2.0}));
  EXPECT_EQ(numbers(SteeringSource::gaussian_curvature), (std::vector{-3.0, -5.0}));
  EXPECT_EQ(numbers(SteeringSource::max_curvature), (std::vector{3.0, -5.0}));
  EXPECT_EQ(numbers(SteeringSource::abs_curvature), (std::vector{std::sqrt(5.0), std::sqrt(13.0)}));
  EXPECT_EQ(numbers(SteeringSource::height), (std::vector{2.0, 5.0}));
  EXPECT_EQ(steering_numbers(two_vertices(), {}, {.source = SteeringSource::height}, UpAxis::z),
            (std::vector{3.0, 6.0}));
  const Steering by_quality{.source = SteeringSource::attribute, .attribute = "quality"};
  EXPECT_EQ(steering_numbers(two_vertices(), {}, by_quality, UpAxis::y), (std::vector{0.25, 0.75}));
}

TEST(SteeringNumbers, SayWhichAttributesThereAre) {
  const Steering by_rust{.source = SteeringSource::attribute, .attribute = "rust"};
  PolygonMesh mesh = two_vertices();
  const auto message = [&] {
    return message_of<std::invalid_argument>([&] { steering_numbers(mesh, {}, by_rust, UpAxis::y); });
  };
  EXPECT_EQ(message(), "attribute is rust; the vertices have quality, red");
  mesh.properties.clear();
  EXPECT_EQ(message(), "attribute is rust; the vertices have none");
}

// The same torus with its inside cut up 16 times as finely, or with vertices of their own for each face: what
// the surface is like has not changed, and so the range has not, to within a step of the coarse mesh.
TEST(SteeringNumbers, RangesDoNotDependOnTheDensityOfVertices) {
  const PolygonMesh torus = torus_mesh(1.0, 0.4, {.n = 60});
  std::vector<double> lengths;
  for (const Vec<3>& p : torus.positions) lengths.push_back(std::hypot(p.x, p.z) < 0.8 ? 0.02 : 1.0);
  const PolygonMesh uneven = refine(torus, lengths).mesh;
  ASSERT_GT(uneven.positions.size(), 2 * torus.positions.size());
  const auto weights_of = [](const PolygonMesh& mesh) {
    std::vector<double> distances;
    for (const Vec<3>& p : mesh.positions) distances.push_back(std::hypot(p.x, p.z));
    return make_weights(distances, {.low_percentile = 20.0, .high_percentile = 80.0},
                        vertex_areas(SurfaceMesh(mesh)));
  };
  const SteeringWeights expected = weights_of(torus);
  for (const PolygonMesh& mesh : {uneven, split_at_every_edge(torus)}) {
    EXPECT_NEAR(weights_of(mesh).low, expected.low, 0.02);
    EXPECT_NEAR(weights_of(mesh).high, expected.high, 0.02);
  }
}

// From creases to ridges, by the sign: the middle of a symmetric wave is in the middle of the range.
TEST(SteeringNumbers, OfMeanCurvatureGoFromCreasesToRidges) {
  const PolygonMesh mesh =
      graph_mesh(1.0, {.n = 60}, [](double x, double) { return 0.1 * std::cos(6.0 * x); });
  const Steering steering{.source = SteeringSource::mean_curvature};
  const SteeringWeights weights = make_weights(
      steering_numbers(mesh, measure_curvature(SurfaceMesh(mesh)), steering, UpAxis::y), steering);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double height = mesh.positions[v].z / 0.1;
    if (height > 0.95) {
      EXPECT_GT(weights.weights[v], 0.9f);
    } else if (height < -0.95) {
      EXPECT_LT(weights.weights[v], 0.1f);
    }
  }
}

}  // namespace
}  // namespace solidnoise::steering_numbers_test
