#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/displace.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/vertex_parameters.h"

namespace solidnoise::bad_mesh_test {
namespace {

// Triangles between vertices at random, with all the faults there are: edges of many faces, faces without
// area, twice or inside out, vertices at one position, on one line, or in no face.
PolygonMesh triangle_soup(std::uint64_t seed, double scale) {
  constexpr std::uint64_t kVertices = 40;
  RandomStream stream(derive_seed(seed, 0));
  PolygonMesh mesh;
  for (std::uint64_t v = 0; v < kVertices; ++v) {
    // Coordinates on a coarse lattice coincide often.
    const double x = std::floor(4.0 * stream.next_unit());
    const double y = std::floor(4.0 * stream.next_unit());
    const double z = v % 3 == 0 ? stream.next_unit() : 0.0;
    mesh.positions.push_back(scale * Vec<3>(x, y, z));
  }
  const std::uint64_t faces = 10 + stream.next() % 200;
  for (std::uint64_t f = 0; f < faces; ++f) {
    const auto a = static_cast<std::uint32_t>(stream.next() % (kVertices - 1));
    const auto b = static_cast<std::uint32_t>(stream.next() % (kVertices - 1));
    const auto c = static_cast<std::uint32_t>(stream.next() % (kVertices - 1));
    mesh.add_face(Triangle{a, b, c});
  }
  return mesh;
}

void expect_unit(const std::vector<Vec<3>>& vectors) {
  for (const Vec<3>& vector : vectors) EXPECT_NEAR(glm::length(vector), 1.0, 1e-9);
}

TEST(BadMesh, HasFiniteValuesAtEveryVertex) {
  for (const double scale : {1.0, 1e-20, 1e20}) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      SCOPED_TRACE(testing::Message() << "scale " << scale << ", seed " << seed);
      PolygonMesh mesh = triangle_soup(seed, scale);
      const SurfaceMesh surface(mesh);
      expect_unit(surface.normals());
      for (const double area : surface.areas()) EXPECT_TRUE(std::isfinite(area) && area >= 0.0);

      const Curvature curvature = measure_curvature(surface, {.rounds = 1, .radius = 0.5 * scale});
      for (std::size_t v = 0; v < curvature.size(); ++v) {
        EXPECT_TRUE(std::isfinite(curvature.k1[v]) && std::isfinite(curvature.k2[v]));
        EXPECT_GE(curvature.k1[v], curvature.k2[v]);
      }
      expect_unit(curvature.k1_direction);
      expect_unit(curvature.k2_direction);
      expect_unit(curvature_directions(surface, curvature, PrincipalDirection::larger, 3));
      expect_unit(axis_directions(surface.normals(), Vec<3>(0.0, 0.0, 1.0)));

      const RefinedMesh refined =
          refine(mesh, std::array{0.7 * scale}, {.placement = RefineOptions::Placement::smooth});
      for (const Vec<3>& p : refined.mesh.positions) EXPECT_TRUE(std::isfinite(glm::length(p)));
      displace(mesh, surface.to_vertices(surface.normals()), std::vector<float>(mesh.positions.size(), 0.1f));
      for (const Vec<3>& p : mesh.positions) EXPECT_TRUE(std::isfinite(glm::length(p)));
      if (testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace solidnoise::bad_mesh_test
