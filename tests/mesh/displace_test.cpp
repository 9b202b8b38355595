#include "solidnoise/mesh/displace.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/mesh/surface_mesh.h"
#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::displace_test {
namespace {

std::vector<Vec<3>> normals_of(const PolygonMesh& mesh) {
  const SurfaceMesh surface(mesh);
  return surface.to_vertices(surface.normals());
}

TEST(Displace, MovesAlongTheNormal) {
  const PolygonMesh rest = sphere_mesh(1.0, {.n = 30});
  PolygonMesh mesh = rest;
  std::vector<float> amounts(mesh.positions.size());
  for (std::size_t v = 0; v < amounts.size(); ++v) amounts[v] = 0.25f * static_cast<float>(v % 3) - 0.25f;
  displace(mesh, normals_of(mesh), amounts);
  const SurfaceMesh surface(rest);
  for (std::size_t v = 0; v < amounts.size(); ++v) {
    EXPECT_LT(glm::length(mesh.positions[v] - rest.positions[v] -
                          static_cast<double>(amounts[v]) * surface.normals()[v]),
              1e-15);
  }
  EXPECT_TRUE(mesh.properties.empty());
}

TEST(Displace, KeepsSeamsClosed) {
  PolygonMesh mesh = split_at_every_edge(sphere_mesh(1.0, {.n = 5, .jitter = 0.3}));
  std::vector<float> amounts(mesh.positions.size());
  for (std::size_t v = 0; v < amounts.size(); ++v) amounts[v] = 0.01f * static_cast<float>(v % 7);
  const std::size_t points = SurfaceMesh(mesh).point_count();
  displace(mesh, normals_of(mesh), amounts);
  EXPECT_EQ(SurfaceMesh(mesh).point_count(), points);
}

TEST(Displace, MakesTheNormalsOfTheNewSurface) {
  PolygonMesh mesh = sphere_mesh(1.0, {.n = 60});
  set_normals(mesh);
  ASSERT_EQ(mesh.properties.size(), 3u);
  const auto normal = [&](std::size_t v) {
    return Vec<3>(mesh.properties[0].values[v], mesh.properties[1].values[v], mesh.properties[2].values[v]);
  };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(glm::length(normal(v) - mesh.positions[v]), 0.01);
  }
  // Stretched by 1 + y / 2: the normal is along the gradient of |p| - 1 - y / (2 |p|).
  std::vector<float> amounts;
  for (const Vec<3>& p : mesh.positions) amounts.push_back(static_cast<float>(0.5 * p.y));
  displace(mesh, normals_of(mesh), amounts);
  // Within an edge's angle, 0.026, and a bit for the stretch.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec<3>& p = mesh.positions[v];
    const double r = glm::length(p);
    const Vec<3> gradient = p / r - Vec<3>(0.0, 0.5 / r, 0.0) + 0.5 * p.y / (r * r * r) * p;
    EXPECT_LT(glm::length(normal(v) - glm::normalize(gradient)), 0.03);
  }
  EXPECT_EQ(mesh.properties.size(), 3u);
}

TEST(Displace, RefusesAmountsThatAreNotNumbers) {
  PolygonMesh mesh = sphere_mesh(1.0, {.n = 2});
  std::vector<float> amounts(mesh.positions.size());
  amounts[3] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(message_of<std::invalid_argument>([&] { displace(mesh, normals_of(mesh), amounts); }),
            "the displacement of vertex 3 is not finite");
  amounts.pop_back();
  EXPECT_EQ(message_of<std::invalid_argument>([&] { displace(mesh, normals_of(mesh), amounts); }),
            "there are 25 displacements for 26 vertices");
  const std::vector<Vec<3>> normals(7, Vec<3>(0.0, 0.0, 1.0));
  amounts.resize(mesh.positions.size());
  EXPECT_EQ(message_of<std::invalid_argument>([&] { displace(mesh, normals, amounts); }),
            "there are 7 normals for 26 vertices");
}

}  // namespace
}  // namespace solidnoise::displace_test
