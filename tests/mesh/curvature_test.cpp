#include "solidnoise/mesh/curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/mesh/surface_smoothing.h"
#include "support/known_curvature.h"
#include "support/surfaces.h"

namespace solidnoise::curvature_test {
namespace {

// A surface of known curvature, at any resolution.
struct KnownSurface {
  std::string name;
  std::function<PolygonMesh(const Tessellation&)> mesh;
  std::function<PrincipalCurvatures(const Vec<3>&)> curvature;
};

const Vec<3> kHalfAxes(1.0, 1.5, 2.0);

std::vector<KnownSurface> known_surfaces() {
  return {{"sphere", [](const Tessellation& t) { return sphere_mesh(2.0, t); },
           [](const Vec<3>&) {
             return PrincipalCurvatures{0.5, 0.5};
           }},
          {"ellipsoid", [](const Tessellation& t) { return ellipsoid_mesh(kHalfAxes, t); },
           [](const Vec<3>& p) { return ellipsoid_curvature(kHalfAxes, p); }},
          {"torus", [](const Tessellation& t) { return torus_mesh(2.0, 0.7, t); },
           [](const Vec<3>& p) { return torus_curvature(2.0, 0.7, p); }},
          {"cylinder", [](const Tessellation& t) { return cylinder_mesh(0.5, 2.0, t); },
           [](const Vec<3>&) {
             return PrincipalCurvatures{2.0, 0.0};
           }},
          {"saddle",
           [](const Tessellation& t) {
             return graph_mesh(1.0, t, [](double x, double y) { return x * y + 0.3 * x * x * x; });
           },
           [](const Vec<3>& p) {
             return graph_curvature({p.y + 0.9 * p.x * p.x, p.x, 1.8 * p.x, 1.0, 0.0});
           }}};
}

struct Errors {
  double mean_rms = 0.0;
  double mean_largest = 0.0;
  double gaussian_rms = 0.0;
  double k1_rms = 0.0;
};

Errors errors_of(const KnownSurface& known, const PolygonMesh& mesh, const CurvatureOptions& options = {}) {
  const Curvature curvature = measure_curvature(SurfaceMesh(mesh), options);
  Errors errors;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const PrincipalCurvatures expected = known.curvature(mesh.positions[v]);
    const double mean = curvature.mean(v) - expected.mean();
    errors.mean_rms += mean * mean;
    errors.mean_largest = std::max(errors.mean_largest, std::abs(mean));
    errors.gaussian_rms += std::pow(curvature.gaussian(v) - expected.gaussian(), 2);
    errors.k1_rms += std::pow(curvature.k1[v] - expected.k1, 2);
  }
  for (double* const sum : {&errors.mean_rms, &errors.gaussian_rms, &errors.k1_rms}) {
    *sum = std::sqrt(*sum / static_cast<double>(mesh.positions.size()));
  }
  return errors;
}

// A cubic leaves an error of order h^2 in second derivatives. That is asserted with a margin, as the order
// between the finest meshes: edges are no small part of the radii of curvature on the coarsest.
TEST(Curvature, ConvergesWithTheSquareOfTheEdgeLength) {
  for (const KnownSurface& known : known_surfaces()) {
    for (const double jitter : {0.0, 0.35}) {
      SCOPED_TRACE(testing::Message() << known.name << ", jitter " << jitter);
      std::vector<Errors> errors;
      for (const int n : {12, 24, 48, 96}) {
        errors.push_back(errors_of(known, known.mesh({.n = n, .jitter = jitter})));
      }
      const auto order = [&](double Errors::*error) {
        return 0.5 * std::log2(errors[1].*error / errors[3].*error);
      };
      const std::string name = known.name + (jitter > 0.0 ? "_irregular_" : "_regular_");
      RecordProperty(name + "mean_rms", std::to_string(errors[3].mean_rms));
      RecordProperty(name + "mean_rms_order", std::to_string(order(&Errors::mean_rms)));
      RecordProperty(name + "mean_largest", std::to_string(errors[3].mean_largest));
      RecordProperty(name + "mean_largest_order", std::to_string(order(&Errors::mean_largest)));
      RecordProperty(name + "gaussian_rms_order", std::to_string(order(&Errors::gaussian_rms)));
      EXPECT_GT(order(&Errors::mean_rms), 1.8);
      EXPECT_GT(order(&Errors::mean_largest), 1.6);
      EXPECT_GT(order(&Errors::gaussian_rms), 1.6);
      EXPECT_GT(order(&Errors::k1_rms), 1.6);
      EXPECT_LT(errors[3].mean_rms, 0.005);
      EXPECT_LT(errors[3].mean_largest, 0.015);
      for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i].mean_rms, errors[i - 1].mean_rms);
    }
  }
}

// sin of the angle between a direction, of either sign, and what it should be.
double sine_between(const Vec<3>& a, const Vec<3>& b) {
  return glm::length(glm::cross(a, glm::normalize(b)));
}

TEST(Curvature, HasThePrincipalDirectionsOfATorus) {
  const PolygonMesh mesh = torus_mesh(2.0, 0.7, {.n = 60, .jitter = 0.35});
  const SurfaceMesh surface(mesh);
  const Curvature curvature = measure_curvature(surface);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec<3>& p = mesh.positions[v];
    const Vec<3>& d1 = curvature.k1_direction[v];
    const Vec<3>& d2 = curvature.k2_direction[v];
    // Errors of the shape operator, here below 0.1, turn it by their share of k1 - k2 > 1.05; and the normals
    // of irregular triangles tilt the plane by up to an edge's angle, 0.1.
    const Vec<3> along(-p.z, 0.0, p.x);
    EXPECT_LT(sine_between(d2, along), 0.1);
    EXPECT_NEAR(glm::length(d1), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(d2), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(d1, d2), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(d1, surface.normals()[v]), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(d2, surface.normals()[v]), 0.0, 1e-12);
  }
}

TEST(Curvature, IsPositiveOnRidgesAndNegativeInCreases) {
  const auto wave = [](double x, double) { return 0.1 * std::cos(6.0 * x); };
  const PolygonMesh mesh = graph_mesh(1.0, {.n = 60}, wave);
  const Curvature curvature = measure_curvature(SurfaceMesh(mesh));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double height = mesh.positions[v].z;
    // k = 0.1 * 36 cos(6 x) on tops and in valleys.
    if (std::abs(height) < 0.09) continue;
    EXPECT_GT(height > 0.0 ? curvature.mean(v) : -curvature.mean(v), 1.0);
  }
}

// Noise of a hundredth of an edge, sigma / h^2 = 3 at this resolution without smoothing.
TEST(Curvature, OfANoisyScanIsMadeGoodBySmoothing) {
  const KnownSurface known = known_surfaces()[1];
  const PolygonMesh mesh = shaken(known.mesh({.n = 48, .jitter = 0.3}), 0.02 * 1.5 * 1.57 / 48);
  const double raw = errors_of(known, mesh).mean_rms;
  // n rounds average over some 4 n independent fits, which the noise of H falls with faster than sqrt(4 n):
  // it has most of its power at the shortest wavelengths.
  EXPECT_LT(errors_of(known, mesh, {.rounds = 2}).mean_rms, raw / std::sqrt(8.0));
  EXPECT_LT(errors_of(known, mesh, {.rounds = 8}).mean_rms, raw / std::sqrt(32.0));
  const double by_radius = errors_of(known, mesh, {.radius = 0.15}).mean_rms;
  RecordProperty("raw_error", std::to_string(raw));
  RecordProperty("error_with_radius", std::to_string(by_radius));
  EXPECT_LT(by_radius, raw / 5.0);  // a disc of this radius has 28 squares of the mesh
}

// A coarse and a fine mesh agree after smoothing by a radius, as they do not by a number of rounds.
TEST(Curvature, SmoothedByARadiusIsThatOfTheSurfaceNotOfTheMesh) {
  const auto largest_mean = [](int n, const CurvatureOptions& options) {
    const PolygonMesh mesh =
        graph_mesh(1.0, {.n = n}, [](double x, double y) { return 0.2 * std::exp(-20.0 * (x * x + y * y)); });
    const Curvature curvature = measure_curvature(SurfaceMesh(mesh), options);
    double largest = 0.0;
    for (std::size_t v = 0; v < curvature.size(); ++v) largest = std::max(largest, curvature.mean(v));
    return largest;
  };
  const CurvatureOptions radius{.radius = 0.3};
  EXPECT_NEAR(largest_mean(60, radius) / largest_mean(150, radius), 1.0, 0.03);
  EXPECT_LT(largest_mean(120, radius), 0.6 * largest_mean(120, CurvatureOptions{}));
  const CurvatureOptions rounds{.rounds = 10};
  EXPECT_LT(largest_mean(60, rounds), 0.9 * largest_mean(150, rounds));
}

// Mean curvatures by themselves: no line is in the way of their smoothing, which is to 1e-4.
TEST(Curvature, HasTheMeanThatIsMeasuredByItself) {
  const SurfaceMesh torus(torus_mesh(2.0, 0.7, {.n = 40, .jitter = 0.3}));
  for (const CurvatureOptions& options : {CurvatureOptions{}, {.rounds = 3}, {.radius = 0.4}}) {
    const Curvature all = measure_curvature(torus, options);
    SurfaceSmoothing smoothing(torus);
    std::vector<Vec<3>> normals = torus.normals();
    smoothing.diffuse(normals, 0.2);
    const std::vector<double> means = measure_mean_curvature(torus, smoothing, options, nullptr);
    ASSERT_EQ(means.size(), all.size());
    for (std::size_t v = 0; v < all.size(); ++v) EXPECT_NEAR(means[v], all.mean(v), 1e-14);
  }
}

TEST(Curvature, HasAValueEverywhere) {
  // A fan of three triangles (a boundary all around), a triangle, one without area, and an isolated vertex.
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0.5}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {5, 0, 0}, {6, 0, 0},
                    {5, 1, 0},   {9, 9, 9}, {20, 0, 0},     {21, 0, 0},      {22, 0, 0}};
  for (const Triangle& face : {Triangle{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {4, 5, 6}, {8, 9, 10}}) {
    mesh.add_face(face);
  }
  for (const CurvatureOptions& options : {CurvatureOptions{}, {.rounds = 2}, {.radius = 0.1}}) {
    const Curvature curvature = measure_curvature(SurfaceMesh(mesh), options);
    for (std::size_t v = 0; v < curvature.size(); ++v) {
      EXPECT_TRUE(std::isfinite(curvature.k1[v]) && std::isfinite(curvature.k2[v])) << v;
      EXPECT_NEAR(glm::length(curvature.k1_direction[v]), 1.0, 1e-12) << v;
      EXPECT_NEAR(glm::length(curvature.k2_direction[v]), 1.0, 1e-12) << v;
      if (v < 4) continue;
      EXPECT_NEAR(curvature.k1[v], 0.0, 1e-12) << v;
      EXPECT_NEAR(curvature.k2[v], 0.0, 1e-12) << v;
    }
    EXPECT_GT(curvature.k2[0], 0.0);
  }
}

// The hub of a fan and its rim: many neighbours on one circle do not determine a cubic.
TEST(Curvature, OfAFanIsThatOfItsSurface) {
  constexpr int kSpokes = 500;
  constexpr int kRings = 4;
  PolygonMesh mesh;
  const auto height = [](double r) { return 0.5 * r * r; };  // H = -1 at the hub
  mesh.positions.push_back({0, 0, 0});
  for (int ring = 1; ring <= kRings; ++ring) {
    for (int i = 0; i < kSpokes; ++i) {
      const double r = 0.05 * ring;
      const double angle = 2.0 * std::numbers::pi * i / kSpokes;
      mesh.positions.push_back({r * std::cos(angle), r * std::sin(angle), height(r)});
    }
  }
  const auto at = [](int ring, int i) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * kSpokes + i % kSpokes);
  };
  for (int i = 0; i < kSpokes; ++i) {
    mesh.add_face(Triangle{0, at(1, i), at(1, i + 1)});
    for (int ring = 1; ring < kRings; ++ring) {
      mesh.add_face(Triangle{at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      mesh.add_face(Triangle{at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
  }
  const Curvature curvature = measure_curvature(SurfaceMesh(mesh));
  EXPECT_NEAR(curvature.mean(0), -1.0, 0.02);
  for (std::size_t v = 0; v < curvature.size(); ++v) EXPECT_NEAR(curvature.mean(v), -1.0, 0.2) << v;
}

}  // namespace
}  // namespace solidnoise::curvature_test
