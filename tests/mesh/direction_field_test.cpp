#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/mesh/vertex_parameters.h"
#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::direction_field_test {
namespace {

const Vec<3> kY(0.0, 1.0, 0.0);

// sin of the angle between lines.
double sine_between(const Vec<3>& a, const Vec<3>& b) {
  return glm::length(glm::cross(a, b));
}

double root_mean_square_sine(const std::vector<Vec<3>>& directions, const Vec<3>& expected) {
  double sum = 0.0;
  for (const Vec<3>& direction : directions) sum += std::pow(sine_between(direction, expected), 2);
  return std::sqrt(sum / static_cast<double>(directions.size()));
}

void expect_unit_tangents(const SurfaceMesh& surface, const std::vector<Vec<3>>& directions) {
  ASSERT_EQ(directions.size(), surface.vertex_count());
  for (std::size_t v = 0; v < directions.size(); ++v) {
    EXPECT_NEAR(glm::length(directions[v]), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(directions[v], surface.normals()[surface.point_of(v)]), 0.0, 1e-12);
  }
}

TEST(AxisDirections, AreTheAxisInTheTangentPlane) {
  const SurfaceMesh sphere(sphere_mesh(2.0, {.n = 15, .jitter = 0.3}));
  const Vec<3> axis(0.3, -2.0, 0.9);
  const std::vector<Vec<3>> directions = axis_directions(sphere.normals(), axis);
  expect_unit_tangents(sphere, directions);
  for (std::size_t v = 0; v < directions.size(); ++v) {
    const Vec<3>& normal = sphere.normals()[v];
    const Vec<3> expected = glm::normalize(axis - glm::dot(axis, normal) * normal);
    EXPECT_LT(sine_between(directions[v], expected), 1e-9);
  }
}

TEST(AxisDirections, AreSomewhereWhereTheAxisIsAlongTheNormal) {
  const SurfaceMesh plane(graph_mesh(1.0, {.n = 4}, [](double, double) { return 0.0; }));
  expect_unit_tangents(plane, axis_directions(plane.normals(), Vec<3>(0.0, 0.0, 5.0)));
  EXPECT_EQ(message_of<std::invalid_argument>([&] { axis_directions(plane.normals(), Vec<3>(0.0)); }),
            "the axis is 0 0 0; it must be finite and not 0");
}

TEST(CurvatureDirections, OfACylinderAreAroundItAndAlongIt) {
  const SurfaceMesh cylinder(cylinder_mesh(0.5, 2.0, {.n = 24, .jitter = 0.3}));
  const Curvature curvature = measure_curvature(cylinder);
  for (const int rounds : {0, 5}) {
    const auto along = curvature_directions(cylinder, curvature, PrincipalDirection::smaller, rounds);
    const auto around = curvature_directions(cylinder, curvature, PrincipalDirection::larger, rounds);
    expect_unit_tangents(cylinder, along);
    expect_unit_tangents(cylinder, around);
    // The normals of irregular triangles lean by up to an edge's angle, 0.08 / 0.5, and the tangents with
    // them.
    for (std::size_t v = 0; v < along.size(); ++v) {
      EXPECT_LT(sine_between(along[v], kY), 0.16);
      EXPECT_NEAR(glm::dot(along[v], around[v]), 0.0, 1e-12);
    }
  }
}

TEST(CurvatureDirections, AreMadeGoodBySmoothing) {
  const PolygonMesh noisy = shaken(cylinder_mesh(0.5, 2.0, {.n = 40, .jitter = 0.2}), 0.004);
  const SurfaceMesh cylinder(noisy);
  const Curvature curvature = measure_curvature(cylinder);
  const auto error = [&](int rounds) {
    return root_mean_square_sine(
        curvature_directions(cylinder, curvature, PrincipalDirection::smaller, rounds), kY);
  };
  const double raw = error(0);
  EXPECT_GT(raw, 0.2);  // the noise of a twelfth of an edge bends as strongly as the cylinder
  EXPECT_LT(error(3), 0.6 * raw);
  EXPECT_LT(error(20), 0.4 * raw);
}

TEST(CurvatureDirections, HaveNoSign) {
  const SurfaceMesh torus(torus_mesh(2.0, 0.7, {.n = 16, .jitter = 0.3}));
  const Curvature curvature = measure_curvature(torus);
  Curvature turned = curvature;
  for (std::size_t v = 0; v < turned.size(); v += 3) turned.k1_direction[v] *= -1.0;
  for (std::size_t v = 0; v < turned.size(); v += 2) turned.k2_direction[v] *= -1.0;
  const auto expected = curvature_directions(torus, curvature, PrincipalDirection::larger, 4);
  const auto directions = curvature_directions(torus, turned, PrincipalDirection::larger, 4);
  for (std::size_t v = 0; v < directions.size(); ++v) EXPECT_EQ(directions[v], expected[v]);
}

// Lines turn by half a circle around the four umbilics of an ellipsoid, and nowhere else: only the few edges
// next to these have ends that differ by more than 1/8 of a circle.
TEST(CurvatureDirections, HaveSingularPointsButNoSeams) {
  const SurfaceMesh ellipsoid(ellipsoid_mesh({1.0, 1.5, 2.0}, {.n = 40, .jitter = 0.3}));
  const auto directions =
      curvature_directions(ellipsoid, measure_curvature(ellipsoid), PrincipalDirection::larger, 3);
  int broken = 0;
  for (std::size_t p = 0; p < ellipsoid.point_count(); ++p) {
    for (const std::uint32_t q : ellipsoid.neighbours(p)) {
      if (q > p && sine_between(directions[p], directions[q]) > std::sqrt(0.5)) ++broken;
    }
  }
  EXPECT_GE(broken, 4);
  EXPECT_LE(broken, 40);
}

TEST(CurvatureDirections, ContinueOverWhatIsFlat) {
  const SurfaceMesh ridge(graph_mesh(1.0, {.n = 40}, [](double x, double) {
    return std::abs(x) < 0.3 ? 0.05 * std::pow(0.09 - x * x, 2) / 0.0081 : 0.0;
  }));
  const auto directions =
      curvature_directions(ridge, measure_curvature(ridge), PrincipalDirection::smaller, 2);
  // Where the foot of the ridge, a jump of the curvature, meets the boundary, the fits are off.
  EXPECT_LT(root_mean_square_sine(directions, kY), 0.1);
  for (const Vec<3>& direction : directions) EXPECT_LT(sine_between(direction, kY), 0.3);
}

TEST(CurvatureDirections, OfAPlaneAreTheUpAxis) {
  const SurfaceMesh plane(graph_mesh(1.0, {.n = 8}, [](double, double) { return 0.0; }));
  const auto directions =
      curvature_directions(plane, measure_curvature(plane), PrincipalDirection::larger, 2);
  for (const Vec<3>& direction : directions) EXPECT_LT(sine_between(direction, kY), 1e-6);
}

TEST(CurvatureDirections, DoNotSeeSplitVertices) {
  const PolygonMesh mesh = ellipsoid_mesh({1.0, 1.5, 2.0}, {.n = 12, .jitter = 0.3});
  const SurfaceMesh whole(mesh);
  const SurfaceMesh split(split_at_every_edge(mesh));
  const auto expected = curvature_directions(whole, measure_curvature(whole), PrincipalDirection::larger, 3);
  const auto directions =
      curvature_directions(split, measure_curvature(split), PrincipalDirection::larger, 3);
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    EXPECT_EQ(directions[corner], directions[split.vertex_at(split.point_of(corner))]);
    EXPECT_LT(sine_between(directions[corner], expected[mesh.corners[corner]]), 1e-6);
  }
}

TEST(CurvatureDirections, AreTheSameForAnyNumberOfThreads) {
  const SurfaceMesh torus(torus_mesh(2.0, 0.7, {.n = 40, .jitter = 0.3}));
  const Curvature curvature = measure_curvature(torus);
  const auto parallel = curvature_directions(torus, curvature, PrincipalDirection::larger, 5);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(curvature_directions(torus, curvature, PrincipalDirection::larger, 5), parallel);
}

TEST(CurvatureDirections, RefuseWhatDoesNotFit) {
  const SurfaceMesh plane(graph_mesh(1.0, {.n = 2}, [](double, double) { return 0.0; }));
  EXPECT_EQ(message_of<std::invalid_argument>(
                [&] { curvature_directions(plane, {}, PrincipalDirection::larger, 0); }),
            "there are 0 curvatures for 9 vertices");
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              curvature_directions(plane, measure_curvature(plane), PrincipalDirection::larger, -1);
            }),
            "the rounds of smoothing is -1; it must be between 0 and 10000");
}

}  // namespace
}  // namespace solidnoise::direction_field_test
