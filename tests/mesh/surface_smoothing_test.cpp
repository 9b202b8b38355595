#include "solidnoise/mesh/surface_smoothing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "support/surfaces.h"

namespace solidnoise::surface_smoothing_test {
namespace {

using Line = std::complex<double>;

constexpr double kPi = std::numbers::pi;

// On a square of side 2 without flow through its sides the heat equation multiplies cos(pi x) at the distance
// x from a side by exp(-pi^2 t), and an implicit step of time t by 1 / (1 + pi^2 t); a radius r is two steps
// of time r^2 / 8.
TEST(SurfaceSmoothing, DiffusesAsTheHeatEquationDoes) {
  const SurfaceMesh square(graph_mesh(1.0, {.n = 60}, [](double, double) { return 0.0; }));
  SurfaceSmoothing smoothing(square);
  for (const double radius : {0.0, 0.3, 1.0}) {
    const auto before = [&](std::size_t p) { return std::cos(kPi * (square.positions()[p].x + 1.0)); };
    std::vector<double> numbers(square.point_count());
    for (std::size_t p = 0; p < numbers.size(); ++p) numbers[p] = before(p);
    smoothing.diffuse(numbers, radius);
    const double factor = std::pow(1.0 + kPi * kPi * radius * radius / 8.0, -2.0);
    // Squares of side h make pi^2 a share of (pi h)^2 / 12 = 1e-3 smaller.
    for (std::size_t p = 0; p < numbers.size(); ++p) EXPECT_NEAR(numbers[p], factor * before(p), 1e-3);
  }
}

TEST(SurfaceSmoothing, KeepsConstantsAndParallelLines) {
  const SurfaceMesh cylinder(cylinder_mesh(0.7, 2.0, {.n = 20, .jitter = 0.3}));
  const TangentFrames frames(cylinder.normals());
  SurfaceSmoothing smoothing(cylinder);
  std::vector<double> numbers(cylinder.point_count(), 3.0);
  std::vector<Line> lines(cylinder.point_count());
  for (std::size_t p = 0; p < lines.size(); ++p) {
    lines[p] = line_at(frames[p].in_frame(Vec<3>(0.0, 1.0, 0.0)));
  }
  const std::vector<Line> before = lines;
  for (int round = 0; round < 5; ++round) {
    smoothing.average(numbers, cylinder.areas());
    smoothing.average(lines, cylinder.areas());
  }
  smoothing.diffuse(numbers, 0.5);
  smoothing.diffuse(lines, 0.5);
  for (std::size_t p = 0; p < lines.size(); ++p) {
    EXPECT_NEAR(numbers[p], 3.0, 1e-5);
    // The normals at the ends lean by up to an edge's angle (0.14), there and back.
    EXPECT_LT(std::abs(lines[p] - before[p]), 0.05);
  }
}

// What leaves a place arrives elsewhere; nothing overshoots.
TEST(SurfaceSmoothing, KeepsTheIntegralAndTheRange) {
  const SurfaceMesh torus(torus_mesh(2.0, 0.7, {.n = 24, .jitter = 0.35}));
  SurfaceSmoothing smoothing(torus);
  std::vector<double> numbers(torus.point_count());
  numbers[100] = 1.0;
  smoothing.diffuse(numbers, 0.3);
  double integral = 0.0;
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    integral += torus.areas()[p] * numbers[p];
    EXPECT_GT(numbers[p], -1e-4);
    EXPECT_LT(numbers[p], 0.5);
  }
  EXPECT_NEAR(integral, torus.areas()[100], 1e-3 * torus.areas()[100]);
}

// As on a square, on one whose triangles are 40 times as long as wide.
TEST(SurfaceSmoothing, DiffusesAcrossLongThinTriangles) {
  PolygonMesh mesh = graph_mesh(1.0, {.n = 60}, [](double, double) { return 0.0; });
  for (Vec<3>& position : mesh.positions) position.y /= 40.0;
  const SurfaceMesh strip(mesh);
  const auto before = [&](std::size_t p) { return std::cos(kPi * (strip.positions()[p].x + 1.0)); };
  std::vector<double> numbers(strip.point_count());
  for (std::size_t p = 0; p < numbers.size(); ++p) numbers[p] = before(p);
  SurfaceSmoothing(strip).diffuse(numbers, 0.3);
  const double factor = std::pow(1.0 + kPi * kPi * 0.3 * 0.3 / 8.0, -2.0);
  for (std::size_t p = 0; p < numbers.size(); ++p) EXPECT_NEAR(numbers[p], factor * before(p), 1e-3);
}

// Each round of the two steps asks once whether to go on.
class CountsRounds final : public Progress {
 public:
  void advance(std::uint64_t, std::uint64_t) override {}
  bool cancelled() override {
    ++rounds;
    return false;
  }
  int rounds = 0;
};

// At the poles of a sphere of meridians triangles are a hundred times as long as wide. Rounds that see no
// farther than the next point would be some hundreds.
TEST(SurfaceSmoothing, TakesFewRoundsForAnyTriangles) {
  const SurfaceMesh sphere(with_closed_seams(seamed_sphere_mesh(1.0, 200)));
  std::vector<Vec<3>> vectors = sphere.normals();
  for (std::size_t p = 0; p < vectors.size(); p += 7) vectors[p] *= -1.0;
  CountsRounds counted;
  SurfaceSmoothing(sphere).diffuse(vectors, 0.3, &counted);
  EXPECT_GT(counted.rounds, 2);
  EXPECT_LT(counted.rounds, 60);
}

TEST(SurfaceSmoothing, LeavesPointsWithoutFacesAsTheyAre) {
  PolygonMesh points = torus_mesh(2.0, 0.7, {.n = 24});
  points.face_starts = {0};
  points.corners.clear();
  const SurfaceMesh surface(points);
  std::vector<double> numbers(surface.point_count());
  numbers[7] = 1.0;
  SurfaceSmoothing(surface).diffuse(numbers, 0.5);
  EXPECT_EQ(numbers[7], 1.0);
}

TEST(Transport, IsUndoneByTheWayBackAndKeepsAngles) {
  const SurfaceMesh sphere(sphere_mesh(1.0, {.n = 6, .jitter = 0.3}));
  const TangentFrames frames(sphere.normals());
  for (std::size_t a = 0; a < frames.size(); a += 7) {
    EXPECT_NEAR(glm::length(frames[a].first), 1.0, 1e-14);
    EXPECT_LT(glm::length(glm::cross(frames[a].first, frames[a].second) - frames[a].normal), 1e-14);
    for (std::size_t b = 0; b < frames.size(); b += 5) {
      const Line there = transport(frames[a], frames[b]);
      EXPECT_NEAR(std::abs(there), 1.0, 1e-14);
      EXPECT_LT(std::abs(there * transport(frames[b], frames[a]) - 1.0), 1e-9) << a << ' ' << b;
      // The axis of the rotation, in both tangent planes, stays.
      const Vec<3> axis = glm::cross(frames[a].normal, frames[b].normal);
      EXPECT_LT(std::abs(there * frames[a].in_frame(axis) - frames[b].in_frame(axis)), 1e-9);
    }
  }
}

TEST(Lines, HaveNoSign) {
  for (double angle = -3.0; angle < 3.0; angle += 0.37) {
    const Line direction = std::polar(1.0, angle);
    EXPECT_LT(std::abs(line_at(direction) - line_at(-direction)), 1e-15);
    EXPECT_NEAR(std::abs((direction_of_line(line_at(direction)) / direction).real()), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace solidnoise::surface_smoothing_test
