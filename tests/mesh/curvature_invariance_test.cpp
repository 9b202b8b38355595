#include <array>
#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/mesh/curvature.h"
#include "support/message_of.h"
#include "support/relative_error.h"
#include "support/surfaces.h"

namespace solidnoise::curvature_invariance_test {
namespace {

constexpr std::array kEachSmoothing{CurvatureOptions{}, CurvatureOptions{.rounds = 3},
                                    CurvatureOptions{.radius = 0.2}};

PolygonMesh bumpy_torus() {
  return shaken(torus_mesh(2.0, 0.7, {.n = 20, .jitter = 0.3}), 0.01);
}

// Rounding in the last bits is multiplied by the condition of the fits; the conjugate gradients of a
// smoothing radius stop at 1e-4 of the values, at the same place up to rounding.
constexpr double kRounding = 1e-7;

TEST(CurvatureInvariance, UnderRigidMotion) {
  const PolygonMesh mesh = bumpy_torus();
  PolygonMesh moved = mesh;
  const Vec<3> x(0.36, 0.48, -0.8);
  const Vec<3> y(-0.8, 0.6, 0.0);
  const Vec<3> z = glm::cross(x, y);
  const auto turn = [&](const Vec<3>& p) { return p.x * x + p.y * y + p.z * z; };
  for (Vec<3>& p : moved.positions) p = turn(p) + Vec<3>(3.0, -5.0, 1.0);
  for (const CurvatureOptions& options : kEachSmoothing) {
    const Curvature here = measure_curvature(SurfaceMesh(mesh), options);
    const Curvature there = measure_curvature(SurfaceMesh(moved), options);
    for (std::size_t v = 0; v < here.size(); ++v) {
      EXPECT_NEAR(there.k1[v], here.k1[v], kRounding);
      EXPECT_NEAR(there.k2[v], here.k2[v], kRounding);
      EXPECT_NEAR(std::abs(glm::dot(there.k1_direction[v], turn(here.k1_direction[v]))), 1.0, kRounding);
    }
  }
}

TEST(CurvatureInvariance, FallsWithTheScale) {
  const PolygonMesh mesh = bumpy_torus();
  for (const double scale : {1e-6, 3.0, 1e6}) {
    PolygonMesh scaled = mesh;
    for (Vec<3>& p : scaled.positions) p *= scale;
    for (CurvatureOptions options : kEachSmoothing) {
      const Curvature small = measure_curvature(SurfaceMesh(mesh), options);
      options.radius *= scale;
      const Curvature large = measure_curvature(SurfaceMesh(scaled), options);
      for (std::size_t v = 0; v < small.size(); ++v) {
        EXPECT_NEAR(scale * large.k1[v], small.k1[v], kRounding);
        EXPECT_NEAR(scale * large.k2[v], small.k2[v], kRounding);
      }
    }
  }
}

TEST(CurvatureInvariance, TurnedInsideOutHasTheOppositeSigns) {
  const PolygonMesh mesh = bumpy_torus();
  for (const CurvatureOptions& options : kEachSmoothing) {
    const Curvature outside = measure_curvature(SurfaceMesh(mesh), options);
    const Curvature inside = measure_curvature(SurfaceMesh(flipped(mesh)), options);
    for (std::size_t v = 0; v < outside.size(); ++v) {
      EXPECT_NEAR(inside.k1[v], -outside.k2[v], kRounding);
      EXPECT_NEAR(inside.k2[v], -outside.k1[v], kRounding);
      EXPECT_NEAR(inside.gaussian(v), outside.gaussian(v), kRounding);
      EXPECT_NEAR(std::abs(glm::dot(inside.k1_direction[v], outside.k2_direction[v])), 1.0, kRounding);
    }
  }
}

TEST(CurvatureInvariance, DoesNotSeeSplitVertices) {
  const PolygonMesh mesh = bumpy_torus();
  const PolygonMesh split = split_at_every_edge(mesh);
  for (const CurvatureOptions& options : kEachSmoothing) {
    const Curvature whole = measure_curvature(SurfaceMesh(mesh), options);
    const Curvature parts = measure_curvature(SurfaceMesh(split), options);
    ASSERT_EQ(parts.size(), split.positions.size());
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
      EXPECT_NEAR(parts.k1[corner], whole.k1[mesh.corners[corner]], kRounding);
      EXPECT_NEAR(parts.k2[corner], whole.k2[mesh.corners[corner]], kRounding);
    }
  }
}

TEST(CurvatureInvariance, IsTheSameForAnyNumberOfThreads) {
  const SurfaceMesh surface(shaken(torus_mesh(2.0, 0.7, {.n = 60, .jitter = 0.3}), 0.01));
  for (const CurvatureOptions& options : kEachSmoothing) {
    const Curvature parallel = measure_curvature(surface, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Curvature serial = measure_curvature(surface, options);
    EXPECT_EQ(serial.k1, parallel.k1);
    EXPECT_EQ(serial.k2, parallel.k2);
    EXPECT_EQ(serial.k1_direction, parallel.k1_direction);
  }
}

TEST(CurvatureOptions, AreChecked) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { CurvatureOptions{.rounds = -1}.validate(); }),
            "the rounds of smoothing is -1; it must be between 0 and 10000");
  EXPECT_EQ(message_of<std::invalid_argument>([] { CurvatureOptions{.radius = -0.5}.validate(); }),
            "the smoothing radius is -0.5; it must be at least 0 (world units)");
}

}  // namespace
}  // namespace solidnoise::curvature_invariance_test
