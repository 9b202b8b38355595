#include "solidnoise/mesh/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/mesh/cut_triangle.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::refine_test {
namespace {

PolygonMesh refine_to(const PolygonMesh& mesh, double target, const RefineOptions& options = {}) {
  return refine(mesh, std::array{target}, options).mesh;
}

constexpr RefineOptions kSmooth{.placement = RefineOptions::Placement::smooth};

double longest_edge(const PolygonMesh& mesh) {
  double longest = 0.0;
  for (const auto& [a, b, c] : triangulate(mesh)) {
    const auto& p = mesh.positions;
    longest =
        std::max({longest, glm::distance(p[a], p[b]), glm::distance(p[b], p[c]), glm::distance(p[c], p[a])});
  }
  return longest;
}

Vec<3> vector_area(const PolygonMesh& mesh) {
  Vec<3> sum(0.0);
  for (const auto& [a, b, c] : triangulate(mesh)) {
    const auto& p = mesh.positions;
    sum += 0.5 * glm::cross(p[b] - p[a], p[c] - p[a]);
  }
  return sum;
}

void expect_same_beginning(const PolygonMesh& refined, const PolygonMesh& mesh) {
  ASSERT_GE(refined.positions.size(), mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) EXPECT_EQ(refined.positions[v], mesh.positions[v]);
}

TEST(Refine, KeepsVerticesAndSplitsEdgesUntilTheyAreShortEnough) {
  const PolygonMesh mesh = sphere_mesh(1.0, {.n = 6, .jitter = 0.3});
  for (const double target : {1.0, 0.25, 0.05}) {
    for (const RefineOptions& options : {RefineOptions{}, kSmooth}) {
      const PolygonMesh refined = refine_to(mesh, target, options);
      expect_same_beginning(refined, mesh);
      EXPECT_LE(longest_edge(refined), target);
      const MeshReport report = inspect_mesh(refined);
      EXPECT_TRUE(report.is_closed());  // no corner of a triangle is on an edge of another
      EXPECT_EQ(report.isolated_vertices, 0u);
      EXPECT_EQ(report.degenerate_faces, 0u);
      EXPECT_LT(glm::length(vector_area(refined)), 1e-12);
      // Edges are not split where they need not be: most are longer than half the target.
      EXPECT_TRUE(target > 0.3 || report.mean_edge_length > 0.4 * target);
    }
  }
}

TEST(Refine, LeavesAMeshOfShortEdgesAlone) {
  PolygonMesh mesh = sphere_mesh(1.0, {.n = 6});
  mesh.add_face(std::array{0u, 1u, 2u, 3u});
  const PolygonMesh refined = refine_to(mesh, 10.0);
  EXPECT_EQ(refined.positions, mesh.positions);
  EXPECT_EQ(refined.corners, mesh.corners);
  EXPECT_EQ(refined.face_starts, mesh.face_starts);
}

TEST(Refine, OnEdgesKeepsTheShape) {
  const PolygonMesh mesh = graph_mesh(1.0, {.n = 3, .jitter = 0.3}, [](double x, double y) { return x * y; });
  const PolygonMesh refined = refine_to(mesh, 0.1);
  EXPECT_LT(glm::length(vector_area(refined) - vector_area(mesh)), 1e-12);
  const SurfaceMesh surface(refined);
  for (std::size_t p = 0; p < surface.point_count(); ++p) {
    const Vec<3>& position = surface.positions()[p];
    EXPECT_EQ(surface.on_boundary(p), std::abs(position.x) == 1.0 || std::abs(position.y) == 1.0);
  }
}

TEST(Refine, FollowsTheTargetOfEachVertex) {
  const PolygonMesh mesh = graph_mesh(1.0, {.n = 2}, [](double, double) { return 0.0; });
  std::vector<double> target;
  for (const Vec<3>& p : mesh.positions) target.push_back(p.x < 0.0 ? 0.05 : 0.5);
  const PolygonMesh refined = refine(mesh, target).mesh;
  EXPECT_EQ(inspect_mesh(refined).non_manifold_edges, 0u);
  EXPECT_NEAR(vector_area(refined).z, 4.0, 1e-12);
  std::array<std::size_t, 2> counts{};
  for (const Vec<3>& p : refined.positions) ++counts[p.x < -0.5 ? 0 : 1];
  EXPECT_GT(counts[0], 2 * counts[1]);
}

TEST(Refine, SmoothComesNearerToTheSurface) {
  const PolygonMesh mesh = sphere_mesh(1.0, {.n = 6});
  const auto largest_error = [](const PolygonMesh& refined) {
    double largest = 0.0;
    for (const Vec<3>& p : refined.positions) largest = std::max(largest, std::abs(glm::length(p) - 1.0));
    return largest;
  };
  // A chord of 0.3 is 0.3^2 / 8 below the sphere; a cubic with the right tangents is off by a power more.
  EXPECT_GT(largest_error(refine_to(mesh, 0.05)), 0.01);
  EXPECT_LT(largest_error(refine_to(mesh, 0.05, kSmooth)), 0.002);
}

TEST(Refine, InterpolatesEveryProperty) {
  PolygonMesh mesh = graph_mesh(1.0, {.n = 2, .jitter = 0.3}, [](double x, double y) { return x - 2.0 * y; });
  VertexProperty linear{"quality", ScalarType::float32, {}};
  VertexProperty whole{"red", ScalarType::uint8, {}};
  for (const Vec<3>& p : mesh.positions) {
    linear.values.push_back(3.0 * p.x - p.y);
    whole.values.push_back(std::round(100.0 + 50.0 * p.x));
  }
  mesh.properties = {linear, whole};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    VertexProperty part{std::string(kNormalNames[axis]), ScalarType::float32, {}};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      part.values.push_back(axis == v % 3 ? 1.0 : 0.0);
    }
    mesh.properties.push_back(part);
  }
  const PolygonMesh refined = refine_to(mesh, 0.2);
  ASSERT_EQ(refined.properties.size(), 5u);
  for (std::size_t v = 0; v < refined.positions.size(); ++v) {
    const auto value = [&](std::size_t i) { return refined.properties[i].values.at(v); };
    EXPECT_NEAR(value(0), 3.0 * refined.positions[v].x - refined.positions[v].y, 1e-12);
    EXPECT_EQ(value(1), std::round(value(1)));
    EXPECT_NEAR(value(1), 100.0 + 50.0 * refined.positions[v].x, 3.0);  // half a unit from each round
    EXPECT_NEAR(std::hypot(value(2), value(3), value(4)), 1.0, 1e-12);
  }
}

TEST(Refine, KeepsPolygonsThatAreSmallEnough) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {5, 1, 0}};
  mesh.add_face(std::array{0u, 1u, 2u, 3u});
  mesh.add_face(std::array{1u, 4u, 5u, 2u});
  const PolygonMesh refined = refine_to(mesh, 1.5);
  EXPECT_EQ(std::vector<std::uint32_t>(refined.face(0).begin(), refined.face(0).end()),
            (std::vector<std::uint32_t>{0, 1, 2, 3}));
  for (std::size_t f = 1; f < refined.face_count(); ++f) EXPECT_EQ(refined.face(f).size(), 3u);
  EXPECT_NEAR(vector_area(refined).z, 5.0, 1e-12);
}

TEST(Refine, SplitsAnEdgeOfManyFacesForAllOfThem) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  for (const Triangle& face : {Triangle{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 0, 1}}) mesh.add_face(face);
  const PolygonMesh refined = refine_to(mesh, 0.3);
  EXPECT_LE(longest_edge(refined), 0.3);
  // The edge is in four parts, each of three faces; the face without area adds itself to each.
  EXPECT_EQ(inspect_mesh(refined).non_manifold_edges, 4u);
  EXPECT_EQ(inspect_mesh(subdivide(mesh, 2).mesh).non_manifold_edges, 4u);
}

TEST(Refine, KeepsSeamsClosed) {
  const PolygonMesh split = split_at_every_edge(sphere_mesh(1.0, {.n = 4, .jitter = 0.3}));
  std::vector<double> target(split.positions.size());
  for (std::size_t v = 0; v < target.size(); ++v) target[v] = detail::uniform(3, v, 0.05, 0.3);
  for (const RefineOptions& options : {RefineOptions{}, kSmooth}) {
    const SurfaceMesh surface(refine(split, target, options).mesh);
    for (std::size_t p = 0; p < surface.point_count(); ++p) EXPECT_FALSE(surface.on_boundary(p));
  }
}

// The new vertices of both sides are at equal positions, though the sides are apart by rounding.
TEST(Refine, TakesTheSidesOfASeamAsOneLine) {
  const PolygonMesh mesh = seamed_sphere_mesh(1.0, 12);
  const PolygonMesh closed = with_closed_seams(mesh);
  for (const RefineOptions& options : {RefineOptions{}, kSmooth}) {
    const PolygonMesh refined = refine(mesh, std::array{0.1}, options).mesh;
    const PolygonMesh expected = refine(closed, std::array{0.1}, options).mesh;
    expect_same_beginning(refined, mesh);
    EXPECT_EQ(refined.corners, expected.corners);
    const auto old = static_cast<std::ptrdiff_t>(mesh.positions.size());
    EXPECT_TRUE(std::equal(refined.positions.begin() + old, refined.positions.end(),
                           expected.positions.begin() + old, expected.positions.end()));
  }
}

TEST(Subdivide, HalvesEveryEdge) {
  const PolygonMesh mesh = sphere_mesh(1.0, {.n = 3});
  const MeshReport before = inspect_mesh(mesh);
  const PolygonMesh once = subdivide(mesh, 1).mesh;
  expect_same_beginning(once, mesh);
  EXPECT_EQ(once.positions.size(), before.vertices + before.edges);
  EXPECT_EQ(once.face_count(), 4 * before.faces);
  EXPECT_TRUE(inspect_mesh(once).is_closed());
  EXPECT_EQ(subdivide(mesh, 3).mesh.face_count(), 64 * before.faces);
  EXPECT_EQ(subdivide(mesh, 0).mesh.corners, mesh.corners);
  EXPECT_DOUBLE_EQ(longest_edge(subdivide(mesh, 2).mesh), 0.25 * longest_edge(mesh));
}

TEST(RefinedMesh, CarriesWhatVerticesHad) {
  const PolygonMesh mesh = torus_mesh(2.0, 0.7, {.n = 6, .jitter = 0.3});
  const RefinedMesh refined = refine(mesh, std::array{0.2});
  std::vector<float> numbers;
  std::vector<Vec<3>> around;
  for (const Vec<3>& p : mesh.positions) {
    numbers.push_back(static_cast<float>(3.0 * p.x - p.y));
    around.push_back(glm::normalize(Vec<3>(-p.z, 0.0, p.x)) * (numbers.size() % 2 == 0 ? 1.0 : -1.0));
  }
  const std::vector<float> carried = refined.carry(numbers);
  const std::vector<Vec<3>> lines = refined.carry_lines(around);
  ASSERT_EQ(carried.size(), refined.mesh.positions.size());
  ASSERT_EQ(lines.size(), refined.mesh.positions.size());
  for (std::size_t v = 0; v < lines.size(); ++v) {
    const Vec<3>& p = refined.mesh.positions[v];
    EXPECT_NEAR(carried[v], 3.0 * p.x - p.y, 1e-5);
    EXPECT_NEAR(glm::length(lines[v]), 1.0, 1e-12);
    // A quarter of the circle has 4 edges or more: the middle of a chord is along the circle.
    EXPECT_LT(std::abs(glm::dot(lines[v], glm::normalize(Vec<3>(p.x, 0.0, p.z)))), 0.2);
  }
}

TEST(Refine, IsTheSameForAnyNumberOfThreads) {
  const PolygonMesh mesh = torus_mesh(2.0, 0.7, {.n = 12, .jitter = 0.3});
  const PolygonMesh parallel = refine_to(mesh, 0.05, kSmooth);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const PolygonMesh serial = refine_to(mesh, 0.05, kSmooth);
  EXPECT_EQ(serial.positions, parallel.positions);
  EXPECT_EQ(serial.corners, parallel.corners);
}

TEST(Refine, RefusesWhatItCannotDo) {
  const PolygonMesh mesh = sphere_mesh(1.0, {.n = 3});
  const auto message = [](const auto& action) { return message_of<std::invalid_argument>(action); };
  EXPECT_EQ(message([&] { refine_to(mesh, 0.0); }),
            "the length of edges is 0; it must be greater than 0 (world units)");
  std::vector<double> target(mesh.positions.size(), 1.0);
  target[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message([&] { refine(mesh, target); }),
            "the length of edges at vertex 4 is nan; it must be greater than 0 (world units)");
  target.pop_back();
  EXPECT_EQ(message([&] { refine(mesh, target); }), "there are 55 lengths of edges for 56 vertices");
  EXPECT_EQ(message([&] { refine_to(mesh, 1e-3, {.most_vertices = 1000}); }),
            "refining takes more than 1000 vertices, the most that there is room for: refine less");
  EXPECT_EQ(message([&] { subdivide(mesh, -1); }),
            "the rounds of refining is -1; it must be between 0 and 16");
}

// Up to the last one: what is known without counting is never more.
TEST(Refine, CountsTheFacesThatItMakes) {
  PolygonMesh equilateral;
  equilateral.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  equilateral.add_face(Triangle{0, 1, 2});
  for (const PolygonMesh& mesh : {equilateral, sphere_mesh(1.0, {.n = 6, .jitter = 0.3})}) {
    for (const double target : {1.0, 0.25, 0.0625}) {
      std::vector<double> targets(mesh.positions.size(), target);
      targets.front() *= 0.5;
      const double made = static_cast<double>(refine(mesh, targets).mesh.face_count());
      EXPECT_EQ(refined_faces(mesh, targets, {}, made), made);
      EXPECT_EQ(refined_faces(mesh, targets, {}, made - 1.0), std::numeric_limits<double>::infinity());
    }
  }
}

TEST(Refine, RefusesTooManyFacesBeforeAnyWork) {
  const auto refusal = [](const PolygonMesh& mesh, double target, RefineOptions options) {
    return message_of<std::invalid_argument>([&] { refine_to(mesh, target, options); });
  };
  const std::string most =
      "refining takes more than 100000000 faces, the most that there is room for: refine less";
  PolygonMesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  square.add_face(std::array<std::uint32_t, 4>{0, 1, 3, 2});
  PolygonMesh sliver;
  sliver.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-30, 0}};
  sliver.add_face(Triangle{0, 1, 2});
  for (const auto method : {RefineOptions::Method::own, RefineOptions::Method::longest_edge}) {
    EXPECT_EQ(refusal(square, 1e-5, {.method = method}), most);
    EXPECT_EQ(refusal(sliver, 1e-9, {.method = method}), most);
  }
  PolygonMesh repeated = square;
  for (int i = 0; i < 1000; ++i) repeated.add_face(square.face(0));
  EXPECT_EQ(refusal(repeated, 0.5, {.most_faces = 10000}),
            "refining takes more than 10000 faces, the most that there is room for: refine less");
  EXPECT_NO_THROW(refine_to(repeated, 0.5, {.most_faces = 100000}));
}

}  // namespace
}  // namespace solidnoise::refine_test
