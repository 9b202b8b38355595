#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::refine_by_openmesh_test {
namespace {

using Method = RefineOptions::Method;

PolygonMesh open_mesh() {
  return graph_mesh(1.0, {.n = 5, .jitter = 0.3}, [](double, double) { return 0.0; });
}

double longest_edge(const PolygonMesh& mesh) {
  double longest = 0.0;
  for (const Triangle& t : triangulate(mesh)) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]));
    }
  }
  return longest;
}

TEST(RefineByOpenMesh, MakesTheTrianglesOfTheMethod) {
  const PolygonMesh mesh = torus_mesh(2.0, 0.7, {.n = 6, .jitter = 0.3});
  const MeshReport before = inspect_mesh(mesh);
  const PolygonMesh loop = subdivide(mesh, 2, {.method = Method::loop}).mesh;
  EXPECT_EQ(loop.face_count(), 16 * before.faces);
  EXPECT_TRUE(inspect_mesh(loop).is_closed());
  const PolygonMesh sqrt3 = subdivide(mesh, 2, {.method = Method::sqrt3}).mesh;
  EXPECT_EQ(sqrt3.face_count(), 9 * before.faces);
  EXPECT_TRUE(inspect_mesh(sqrt3).is_closed());
  const PolygonMesh longest = subdivide(mesh, 2, {.method = Method::longest_edge}).mesh;
  EXPECT_LE(longest_edge(longest), 0.25 * longest_edge(mesh) * (1.0 + 1e-6));
  EXPECT_TRUE(inspect_mesh(longest).is_closed());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(longest.positions[v], mesh.positions[v]);
    EXPECT_NE(loop.positions[v], mesh.positions[v]) << "smoothed";
  }
}

TEST(RefineByOpenMesh, GoesOnUntilEdgesAreShortEnough) {
  const PolygonMesh mesh = open_mesh();
  for (const Method method : {Method::longest_edge, Method::loop, Method::sqrt3}) {
    const PolygonMesh refined = refine(mesh, std::array{0.1}, {.method = method}).mesh;
    // Smoothing lengthens some edges a little.
    EXPECT_LE(longest_edge(refined), method == Method::longest_edge ? 0.1 : 0.13);
    EXPECT_GT(longest_edge(refined), 0.03);
  }
  EXPECT_EQ(refine(mesh, std::array{9.0}, {.method = Method::loop}).mesh.positions, mesh.positions);
}

// In a plane, numbers that are linear in the place stay so, up to smoothing, which moves places; the faces at
// the boundary are those that the methods treat apart.
TEST(RefineByOpenMesh, CarriesWhatVerticesHad) {
  PolygonMesh mesh = open_mesh();
  std::vector<double> heat;
  for (const Vec<3>& p : mesh.positions) heat.push_back(3.0 * p.x - p.y);
  mesh.properties.push_back({"heat", ScalarType::float64, heat});
  mesh.properties.push_back({"count", ScalarType::uint8, std::vector<double>(heat.size(), 7.0)});
  for (const Method method : {Method::longest_edge, Method::loop, Method::sqrt3}) {
    const RefinedMesh refined = subdivide(mesh, 3, {.method = method});
    ASSERT_EQ(refined.mesh.positions.size(), mesh.positions.size() + refined.parents.size());
    EXPECT_EQ(inspect_mesh(refined.mesh).isolated_vertices, 0u);
    EXPECT_EQ(inspect_mesh(refined.mesh).components, 1u);
    const std::vector<double>& carried = refined.mesh.property("heat")->values;
    ASSERT_EQ(carried.size(), refined.mesh.positions.size());
    EXPECT_EQ(refined.mesh.property("count")->values.back(), 7.0);
    const double moved = method == Method::longest_edge ? 1e-12 : 0.25 * longest_edge(mesh);
    for (std::size_t v = 0; v < carried.size(); ++v) {
      const Vec<3>& p = refined.mesh.positions[v];
      EXPECT_NEAR(carried[v], 3.0 * p.x - p.y, 3.2 * moved) << "vertex " << v;
    }
  }
}

TEST(RefineByOpenMesh, TakesAVertexOfManyNeighbours) {
  PolygonMesh fan;
  constexpr std::uint32_t kCount = 120;
  fan.positions.push_back({0, 0, 1});
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCount;
    fan.positions.push_back({std::cos(angle), std::sin(angle), 0});
    fan.add_face(std::array{0u, 1 + k, 1 + (k + 1) % kCount});
  }
  for (const Method method : {Method::loop, Method::sqrt3}) {
    for (const Vec<3>& p : subdivide(fan, 3, {.method = method}).mesh.positions) {
      EXPECT_LE(glm::length(p), 1.0 + 1e-12);
    }
  }
}

TEST(RefineByOpenMesh, RefusesWhatIsNoManifoldOfTriangles) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  mesh.add_face(std::array{0u, 1u, 2u});
  const auto refusal = [&](const std::vector<std::uint32_t>& face, Method method) {
    PolygonMesh bad = mesh;
    bad.add_face(face);
    return message_of<std::invalid_argument>([&] { subdivide(bad, 1, {.method = method}); });
  };
  const std::string head = "OpenMesh's methods of refining take manifolds of triangles, but face 1 ";
  EXPECT_EQ(refusal({0, 3, 2, 1}, Method::loop), head + "has 4 vertices; the own method takes it");
  EXPECT_EQ(refusal({0, 3, 3}, Method::sqrt3), head + "has a vertex twice; the own method takes it");
  EXPECT_EQ(refusal({0, 1, 3}, Method::longest_edge),
            head +
                "meets an edge of two others, disagrees with its neighbour on the outside, or touches others "
                "in a vertex alone; the own method takes it");
  for (const Method method : {Method::longest_edge, Method::loop, Method::sqrt3}) {
    EXPECT_EQ(message_of<std::invalid_argument>(
                  [&] { refine(mesh, std::array{1e-3}, {.method = method, .most_vertices = 1000}); }),
              "refining takes more than 1000 vertices, the most that there is room for: refine less");
  }
}

}  // namespace
}  // namespace solidnoise::refine_by_openmesh_test
