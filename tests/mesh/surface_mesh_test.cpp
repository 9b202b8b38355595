#include "solidnoise/mesh/surface_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::surface_mesh_test {
namespace {

constexpr double kPi = std::numbers::pi;

PolygonMesh make_mesh(const std::vector<Vec<3>>& positions, const std::vector<Triangle>& faces) {
  PolygonMesh mesh;
  mesh.positions = positions;
  for (const Triangle& face : faces) mesh.add_face(face);
  return mesh;
}

// Two meshes as one, that have no vertex in common.
PolygonMesh both(const PolygonMesh& first, const PolygonMesh& second) {
  PolygonMesh mesh = first;
  const auto offset = static_cast<std::uint32_t>(first.positions.size());
  mesh.positions.insert(mesh.positions.end(), second.positions.begin(), second.positions.end());
  for (std::size_t f = 0; f < second.face_count(); ++f) {
    std::vector<std::uint32_t> face(second.face(f).begin(), second.face(f).end());
    for (std::uint32_t& vertex : face) vertex += offset;
    mesh.add_face(face);
  }
  return mesh;
}

double total_area(const SurfaceMesh& surface) {
  return std::accumulate(surface.areas().begin(), surface.areas().end(), 0.0);
}

std::vector<std::uint32_t> list(std::span<const std::uint32_t> items) {
  return {items.begin(), items.end()};
}

const std::vector<Vec<3>> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(SurfaceMesh, OfASquareHasItsNeighboursBoundaryAreasAndNormals) {
  const SurfaceMesh surface(make_mesh(kSquare, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(list(surface.neighbours(0)), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(list(surface.neighbours(1)), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(list(surface.triangles_at(2)), (std::vector<std::uint32_t>{0, 1}));
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_TRUE(surface.on_boundary(p));
    EXPECT_EQ(surface.normals()[p], Vec<3>(0, 0, 1));
    EXPECT_DOUBLE_EQ(surface.areas()[p], 0.25);  // right angles: all four corners have the same share
  }
  EXPECT_DOUBLE_EQ(surface.mean_edge_length(), (4.0 + std::sqrt(2.0)) / 5.0);
}

TEST(SurfaceMesh, CutsPolygonsIntoFans) {
  PolygonMesh mesh;
  mesh.positions = kSquare;
  mesh.add_face(std::array{0u, 1u, 2u, 3u});
  EXPECT_EQ(SurfaceMesh(mesh).triangles(), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(SurfaceMesh, JoinsSplitVertices) {
  const PolygonMesh torus = torus_mesh(2.0, 0.7, {.n = 12, .jitter = 0.3});
  const SurfaceMesh whole(torus);
  const PolygonMesh split_mesh = split_at_every_edge(torus);
  const SurfaceMesh split(split_mesh);
  ASSERT_EQ(split.point_count(), whole.point_count());
  EXPECT_EQ(split.vertex_count(), torus.corners.size());
  EXPECT_DOUBLE_EQ(split.mean_edge_length(), whole.mean_edge_length());
  const std::vector<Vec<3>> normals = split.to_vertices(split.normals());
  for (std::size_t corner = 0; corner < torus.corners.size(); ++corner) {
    const std::uint32_t vertex = torus.corners[corner];
    const std::uint32_t point = split.point_of(corner);
    EXPECT_EQ(split.positions()[point], torus.positions[vertex]);
    EXPECT_EQ(split_mesh.positions[split.vertex_at(point)], torus.positions[vertex]);
    EXPECT_EQ(split.neighbours(point).size(), whole.neighbours(vertex).size());
    EXPECT_FALSE(split.on_boundary(point));
    EXPECT_EQ(normals[corner], whole.normals()[vertex]);
    EXPECT_EQ(split.areas()[point], whole.areas()[vertex]);
  }
}

TEST(SurfaceMesh, TakesZerosOfEitherSignAsEqual) {
  std::vector<Vec<3>> positions = kSquare;
  positions.insert(positions.end(), {{-0.0, -0.0, -0.0}, {1, 1, -0.0}});
  const SurfaceMesh surface(make_mesh(positions, {{0, 1, 2}, {4, 5, 3}}));
  EXPECT_EQ(surface.point_count(), 4u);
  EXPECT_EQ(surface.point_of(4), 0u);
  EXPECT_EQ(surface.point_of(5), 2u);
}

// What is measured is bit for bit that of the mesh without gaps.
TEST(SurfaceMesh, JoinsSeamsWhoseSidesAreApartByRounding) {
  constexpr std::size_t kRows = 12;
  const PolygonMesh mesh = seamed_sphere_mesh(3.0, kRows);
  const SurfaceMesh seamed(mesh);
  const SurfaceMesh closed(with_closed_seams(mesh));
  ASSERT_EQ(seamed.point_count(), 2 * kRows * (kRows - 1) + 2);
  EXPECT_EQ(seamed.vertex_count(), mesh.positions.size());
  EXPECT_EQ(seamed.positions(), closed.positions());
  EXPECT_EQ(seamed.triangles(), closed.triangles());
  EXPECT_EQ(seamed.normals(), closed.normals());
  EXPECT_EQ(seamed.areas(), closed.areas());
  EXPECT_EQ(seamed.mean_edge_length(), closed.mean_edge_length());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(seamed.point_of(v), closed.point_of(v));
    EXPECT_FALSE(seamed.on_boundary(seamed.point_of(v)));
    EXPECT_EQ(mesh.positions[seamed.vertex_at(seamed.point_of(v))], seamed.positions()[seamed.point_of(v)]);
  }
}

// A gap of a millionth of the mesh is one, and so is one next to which edges are as small; so are two sheets
// that lie on each other but for rounding, inside their boundaries. Points of no face stay as they are.
TEST(SurfaceMesh, LeavesApartWhatRoundingDoesNotExplain) {
  const PolygonMesh two_triangles = make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1e-6, 0}, {1, 1, 0}, {0, 1, 1e-6}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(SurfaceMesh(two_triangles).point_count(), 6u);
  const PolygonMesh with_detail = make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {5, 1e-7, 0}, {5, 0, 1e-7}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(SurfaceMesh(with_detail).point_count(), 6u);
  const PolygonMesh points = make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}}, {});
  EXPECT_EQ(SurfaceMesh(points).point_count(), 3u);

  const PolygonMesh outer = sphere_mesh(1.0, {.n = 6});
  const PolygonMesh inner = flipped(sphere_mesh(1.0 - 1e-9, {.n = 6}));
  const SurfaceMesh shell(both(outer, inner));
  ASSERT_EQ(shell.point_count(), outer.positions.size() + inner.positions.size());
  for (std::size_t v = 0; v < outer.positions.size(); ++v) {
    EXPECT_LT(glm::length(shell.normals()[v] + shell.normals()[v + outer.positions.size()]), 1e-6);
  }
}

// Of sheets back to back, whether their places are equal or apart by rounding, the first one's triangles
// count.
TEST(SurfaceMesh, OfSheetsBackToBackHasTheNormalsOfTheFirst) {
  const auto bowl = [](double x, double y) { return 0.3 * (x * x + y * y); };
  const PolygonMesh sheet = graph_mesh(1.0, {.n = 6}, bowl);
  const SurfaceMesh front(sheet);
  const SurfaceMesh equal(both(sheet, flipped(sheet)));
  EXPECT_EQ(equal.normals(), front.normals());
  EXPECT_EQ(equal.triangles(), front.triangles());

  const PolygonMesh square = make_mesh(kSquare, {{0, 1, 2}, {0, 2, 3}});
  PolygonMesh moved = flipped(square);
  for (Vec<3>& p : moved.positions) p.z = 1e-8;
  const SurfaceMesh near(both(square, moved));
  EXPECT_EQ(near.point_count(), 4u);
  for (const Vec<3>& normal : near.normals()) EXPECT_EQ(normal, Vec<3>(0, 0, 1));
}

// The areas of all points add up to that of the triangles, which tends to the surface's as 1 / n^2.
TEST(SurfaceMesh, SharesTheAreaAmongItsPoints) {
  for (const double jitter : {0.0, 0.35}) {
    const SurfaceMesh torus(torus_mesh(2.0, 0.5, {.n = 48, .jitter = jitter}));
    double of_triangles = 0.0;
    for (const auto& [a, b, c] : torus.triangles()) {
      const auto& p = torus.positions();
      of_triangles += 0.5 * glm::length(glm::cross(p[b] - p[a], p[c] - p[a]));
    }
    EXPECT_NEAR(total_area(torus), of_triangles, 1e-11);
    // A chord polygon of n corners is (pi / n)^2 / 6 shorter than its circle; two circles, and jitter.
    EXPECT_NEAR(total_area(torus), 4.0 * kPi * kPi * 2.0 * 0.5, 4.0 * kPi * kPi * std::pow(kPi / 48, 2));
    for (const double area : torus.areas()) EXPECT_GT(area, 0.0);
  }
}

double largest_normal_error(int n, double jitter) {
  const SurfaceMesh sphere(sphere_mesh(3.0, {.n = n, .jitter = jitter}));
  double largest = 0.0;
  for (std::size_t p = 0; p < sphere.point_count(); ++p) {
    largest = std::max(largest, glm::length(sphere.normals()[p] - sphere.positions()[p] / 3.0));
  }
  return largest;
}

// A normal of irregular triangles is off in proportion to their size: they see the surface from the side that
// has more of them.
TEST(SurfaceMesh, NormalsTendToThoseOfTheSurface) {
  const double coarse = largest_normal_error(12, 0.35);
  const double fine = largest_normal_error(48, 0.35);
  const double between_neighbours = 0.5 * kPi / 48;  // the angle between their normals
  EXPECT_LT(fine, between_neighbours);
  EXPECT_GT(std::log2(coarse / fine) / 2.0, 0.8) << coarse << ' ' << fine;
  EXPECT_LT(largest_normal_error(48, 0.0), 0.005);
}

TEST(SurfaceMesh, FlippedHasTheOppositeNormals) {
  const PolygonMesh mesh = sphere_mesh(1.0, {.n = 10, .jitter = 0.3});
  const SurfaceMesh outside(mesh);
  const SurfaceMesh inside(flipped(mesh));
  for (std::size_t p = 0; p < outside.point_count(); ++p) {
    EXPECT_LT(glm::length(outside.normals()[p] + inside.normals()[p]), 1e-14);
  }
}

TEST(SurfaceMesh, HasANormalAtEveryVertexOfABadMesh) {
  // Isolated; only in a triangle of no area; an edge of three triangles; windings that cancel.
  const std::vector<Vec<3>> positions{{9, 9, 9}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0},  {0, 0, 0},
                                      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {8, 0, 0},
                                      {9, 0, 0}, {8, 1, 0}, {9, 1, 0}};
  const SurfaceMesh surface(make_mesh(
      positions, {{1, 2, 3}, {4, 5, 6}, {4, 5, 7}, {4, 5, 8}, {9, 10, 11}, {10, 11, 12}, {5, 5, 6}}));
  EXPECT_EQ(surface.triangles().size(), 6u);
  for (const Vec<3>& normal : surface.normals()) EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
  EXPECT_EQ(surface.normals()[0], Vec<3>(0, 1, 0));
  EXPECT_EQ(surface.normals()[2], Vec<3>(0, 1, 0));
  EXPECT_NEAR(std::abs(surface.normals()[10].z), 1.0, 1e-12);
  EXPECT_EQ(surface.areas()[0], 0.0);
  EXPECT_FALSE(surface.on_boundary(0));
  EXPECT_TRUE(surface.neighbours(0).empty());
  EXPECT_NEAR(total_area(surface), 2.5, 1e-12);
}

TEST(SurfaceMesh, CountsDuplicateTrianglesOnce) {
  const SurfaceMesh once(make_mesh(kSquare, {{0, 1, 2}, {0, 2, 3}}));
  const SurfaceMesh often(make_mesh(kSquare, {{0, 1, 2}, {0, 2, 3}, {1, 2, 0}, {2, 1, 0}, {3, 2, 0}}));
  EXPECT_EQ(often.triangles(), once.triangles());
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_EQ(often.normals()[p], once.normals()[p]);
    EXPECT_TRUE(often.on_boundary(p));
  }
}

TEST(SurfaceMesh, OfNothingIsEmpty) {
  const SurfaceMesh surface{PolygonMesh{}};
  EXPECT_EQ(surface.point_count(), 0u);
  EXPECT_EQ(surface.mean_edge_length(), 0.0);
}

TEST(SurfaceMesh, RefusesWhatIsNotThere) {
  PolygonMesh mesh = make_mesh(kSquare, {{0, 1, 2}, {0, 2, 4}});
  EXPECT_EQ(message_of<std::invalid_argument>([&] { SurfaceMesh{mesh}; }),
            "face 1 names vertex 4; there are 4 vertices");
  mesh.positions[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of<std::invalid_argument>([&] { SurfaceMesh{mesh}; }),
            "the position of vertex 2 is not finite");
}

TEST(SurfaceMesh, IsTheSameForAnyNumberOfThreads) {
  const PolygonMesh mesh = split_at_every_edge(sphere_mesh(1.0, {.n = 40, .jitter = 0.3}));
  const SurfaceMesh parallel(mesh);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SurfaceMesh serial(mesh);
  EXPECT_EQ(serial.positions(), parallel.positions());
  EXPECT_EQ(serial.normals(), parallel.normals());
  EXPECT_EQ(serial.areas(), parallel.areas());
  EXPECT_EQ(serial.neighbours().items, parallel.neighbours().items);
  EXPECT_EQ(serial.mean_edge_length(), parallel.mean_edge_length());
}

}  // namespace
}  // namespace solidnoise::surface_mesh_test
