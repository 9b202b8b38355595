#include "solidnoise/geometry/inspect_mesh.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace solidnoise::inspect_mesh_test {
namespace {

// A unit cube of six squares.
PolygonMesh cube() {
  PolygonMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& side : kSides) mesh.add_face(side);
  return mesh;
}

TEST(InspectMesh, CountsWhatACubeHas) {
  const MeshReport report = inspect_mesh(cube());
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_EQ(report.faces, 6u);
  EXPECT_EQ(report.edges, 12u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.mean_edge_length, 1.0);
  EXPECT_EQ(report.bounds.upper, Vec<3>(1, 1, 1));
  EXPECT_TRUE(report.is_closed());
  EXPECT_TRUE(mesh_warnings(report).empty());
}

TEST(InspectMesh, CountsBoundariesComponentsAndIsolatedVertices) {
  PolygonMesh mesh = cube();
  mesh.corners.resize(20);
  mesh.face_starts.pop_back();
  mesh.positions.insert(mesh.positions.end(), {{3, 0, 0}, {6, 0, 0}, {3, 4, 0}, {9, 9, -9}});
  mesh.add_face(std::array{8u, 9u, 10u});
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.boundary_edges, 4u + 3u);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.isolated_vertices, 1u);
  EXPECT_EQ(report.bounds.lower, Vec<3>(0, 0, -9));
  EXPECT_DOUBLE_EQ(report.mean_edge_length, (12.0 + 3.0 + 4.0 + 5.0) / 15.0);
  EXPECT_FALSE(report.is_closed());
  EXPECT_TRUE(mesh_warnings(report).empty());
}

TEST(InspectMesh, CountsEveryFault) {
  PolygonMesh mesh = cube();
  mesh.positions.push_back(mesh.positions[7]);
  mesh.positions.push_back({0, 0, 2});
  mesh.add_face(std::array{0u, 1u, 9u});  // a third face on the edge 0 1
  mesh.add_face(std::array{9u, 0u, 1u});  // the same again
  mesh.add_face(std::array{1u, 0u, 9u});  // and the other way around
  mesh.add_face(std::array{7u, 8u, 9u});  // an edge without length, no area
  mesh.add_face(std::array{9u, 0u, 4u});  // on one line
  mesh.add_face(std::array{3u, 3u, 9u});  // a vertex twice
  mesh.add_face(std::array{5u, 9u});      // two corners
  mesh.add_face(std::array{5u});          // one
  for (int none = 0; none < 2; ++none) mesh.add_face(std::span<const std::uint32_t>());
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.duplicate_faces, 2u + 1u);
  EXPECT_EQ(report.zero_length_edges, 1u);
  EXPECT_EQ(report.degenerate_faces, 4u + 3u);
  EXPECT_EQ(report.isolated_vertices, 0u);
  // In more than two faces: 0 1 (five); 0 4 (three); 0 9 and 1 9 (four and three).
  EXPECT_EQ(report.non_manifold_edges, 4u);
  EXPECT_FALSE(report.is_closed());
  EXPECT_EQ(mesh_warnings(report).front(), "4 edges are between more than two faces");
  EXPECT_EQ(mesh_warnings(report).back(), "3 faces repeat an earlier one");
}

TEST(InspectMesh, CountsEdgesOfFacesThatAreInsideOut) {
  PolygonMesh mesh = cube();
  std::swap(mesh.corners[1], mesh.corners[3]);
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.flipped_edges, 4u);
  EXPECT_EQ(mesh_warnings(report),
            std::vector<std::string>{
                "4 edges are between faces that disagree on the outside: curvature means nothing there"});
}

}  // namespace
}  // namespace solidnoise::inspect_mesh_test
