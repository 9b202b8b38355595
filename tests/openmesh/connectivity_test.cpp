#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LongestEdgeT.hh>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "support/surfaces.h"

// A second opinion by OpenMesh on what is next to what, on manifolds, which it can represent.
namespace solidnoise::connectivity_test {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

HalfEdgeMesh to_openmesh(const PolygonMesh& mesh) {
  HalfEdgeMesh result;
  std::vector<HalfEdgeMesh::VertexHandle> vertices;
  for (const Vec<3>& p : mesh.positions) vertices.push_back(result.add_vertex({p.x, p.y, p.z}));
  for (const auto& [a, b, c] : triangulate(mesh)) result.add_face(vertices[a], vertices[b], vertices[c]);
  return result;
}

std::vector<PolygonMesh> manifolds() {
  const auto flat = [](double x, double y) { return 0.3 * x * y; };
  return {sphere_mesh(1.0, {.n = 7, .jitter = 0.35}), torus_mesh(2.0, 0.7, {.n = 9, .jitter = 0.35}),
          cylinder_mesh(0.5, 2.0, {.n = 8, .jitter = 0.35}), graph_mesh(1.0, {.n = 8, .jitter = 0.35}, flat)};
}

TEST(SurfaceMesh, HasTheNeighboursAndBoundariesOfOpenMesh) {
  for (const PolygonMesh& mesh : manifolds()) {
    const SurfaceMesh surface(mesh);
    const HalfEdgeMesh expected = to_openmesh(mesh);
    ASSERT_EQ(expected.n_faces(), surface.triangles().size());
    double length = 0.0;
    for (const auto edge : expected.edges()) length += expected.calc_edge_length(edge);
    EXPECT_NEAR(surface.mean_edge_length(), length / static_cast<double>(expected.n_edges()), 1e-12);
    for (const auto vertex : expected.vertices()) {
      const auto point = static_cast<std::size_t>(vertex.idx());
      std::vector<std::uint32_t> neighbours;
      for (const auto other : vertex.vertices())
        neighbours.push_back(static_cast<std::uint32_t>(other.idx()));
      std::sort(neighbours.begin(), neighbours.end());
      const auto found = surface.neighbours(point);
      EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), neighbours);
      EXPECT_EQ(surface.on_boundary(point), vertex.is_boundary());
    }
  }
}

// OpenMesh halves the longest edge first, one at a time, which takes the fewest vertices; halving all edges
// that are too long at once, in rounds, must not take many more.
TEST(Refine, TakesLittleMoreVerticesThanOpenMesh) {
  for (const PolygonMesh& mesh : manifolds()) {
    constexpr double kTarget = 0.08;
    HalfEdgeMesh expected = to_openmesh(mesh);
    OpenMesh::Subdivider::Uniform::LongestEdgeT<HalfEdgeMesh, double> subdivider;
    subdivider.set_max_edge_length(kTarget);
    subdivider.attach(expected);
    subdivider(1);
    subdivider.detach();
    const PolygonMesh refined = refine(mesh, std::array{kTarget}).mesh;
    RecordProperty("vertices_over_openmesh", std::to_string(static_cast<double>(refined.positions.size()) /
                                                            static_cast<double>(expected.n_vertices())));
    EXPECT_LT(static_cast<double>(refined.positions.size()),
              1.25 * static_cast<double>(expected.n_vertices()));
    EXPECT_GT(static_cast<double>(refined.positions.size()),
              0.5 * static_cast<double>(expected.n_vertices()));
  }
}

}  // namespace
}  // namespace solidnoise::connectivity_test
