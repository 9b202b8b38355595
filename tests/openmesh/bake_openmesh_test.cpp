#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/mesh/openmesh.h"
#include "support/message_of.h"
#include "support/surfaces.h"

namespace solidnoise::bake_openmesh_test {
namespace {

struct BytesTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  using Color = OpenMesh::Vec4uc;
  VertexAttributes(OpenMesh::Attributes::Color | OpenMesh::Attributes::Normal);
};
struct FloatsTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Color = OpenMesh::Vec3f;
};
struct AlphaTraits : OpenMesh::DefaultTraits {
  using Color = OpenMesh::Vec4f;
  VertexAttributes(OpenMesh::Attributes::Color);
};

template <typename Mesh>
Mesh to_openmesh(const PolygonMesh& mesh) {
  Mesh result;
  using Scalar = typename Mesh::Scalar;
  for (const Vec<3>& p : mesh.positions) {
    result.add_vertex({static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z)});
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<typename Mesh::VertexHandle> corners;
    for (const std::uint32_t corner : mesh.face(f)) corners.emplace_back(static_cast<int>(corner));
    result.add_face(corners);
  }
  return result;
}

// Every number of the vertices under this name.
template <typename Value, typename Mesh>
std::vector<Value> values_of(const Mesh& mesh, const std::string& name) {
  std::vector<Value> values;
  openmesh::take_property<Value>(mesh, name, [&](const Value& value) { values.push_back(value); });
  return values;
}

template <typename Mesh>
class OfOpenMesh : public testing::Test {};
using Meshes = testing::Types<OpenMesh::TriMesh_ArrayKernelT<>, OpenMesh::PolyMesh_ArrayKernelT<BytesTraits>,
                              OpenMesh::TriMesh_ArrayKernelT<FloatsTraits>,
                              OpenMesh::PolyMesh_ArrayKernelT<AlphaTraits>>;
TYPED_TEST_SUITE(OfOpenMesh, Meshes);

TYPED_TEST(OfOpenMesh, GetsTheColorsAndNumbersThatAPolygonMeshGets) {
  TypeParam mesh = to_openmesh<TypeParam>(torus_mesh(1.0, 0.4, {.n = 12, .jitter = 0.3}));
  BakeRecipe recipe;
  recipe.noise.kind = SurfaceNoiseKind::oriented;
  recipe.frequency = ParameterRange{2.0, 6.0};
  recipe.properties["height"] = {.use = "value", .ramp = {{-1.0, 0.0}, {2.0, 1.0}}};
  const std::vector<std::string> keep{"frequency", "direction", "gradient"};
  const BakedMesh expected = bake(plan_bake(polygon_mesh(mesh), recipe), recipe, keep);

  const Moments moments = bake(mesh, recipe, keep);
  EXPECT_EQ(moments.sigma(), expected.moments.sigma());
  const auto noise = values_of<float>(mesh, "noise");
  const auto frequency = values_of<float>(mesh, "frequency");
  const auto direction = values_of<OpenMesh::Vec3f>(mesh, "direction");
  const auto height = values_of<float>(mesh, "height");
  const auto gradient = values_of<OpenMesh::Vec3f>(mesh, "gradient");
  ASSERT_EQ(noise.size(), expected.colors.size());
  ASSERT_EQ(height.size(), noise.size());
  ASSERT_EQ(gradient.size(), noise.size());
  ASSERT_EQ(frequency.size(), noise.size());
  ASSERT_EQ(direction.size(), noise.size());
  ASSERT_TRUE(mesh.has_vertex_colors());
  for (std::size_t v = 0; v < noise.size(); ++v) {
    EXPECT_EQ(noise[v], expected.mesh.property("noise")->values[v]);
    EXPECT_EQ(frequency[v], static_cast<float>(expected.mesh.property("frequency")->values[v]));
    EXPECT_EQ(height[v], static_cast<float>(expected.mesh.property("height")->values[v]));
    EXPECT_EQ(gradient[v][2], static_cast<float>(expected.mesh.property("gradient_z")->values[v]));
    EXPECT_EQ(direction[v][1], static_cast<float>(expected.mesh.property("direction_y")->values[v]));
    const auto color = OpenMesh::color_cast<OpenMesh::Vec4f>(OpenMesh::color_cast<OpenMesh::Vec3uc>(
        OpenMesh::color_cast<OpenMesh::Vec4f>(mesh.color(OpenMesh::VertexHandle(static_cast<int>(v))))));
    EXPECT_EQ(std::lround(255.0f * color[0]), std::lround(expected.mesh.property("red")->values[v]));
    EXPECT_EQ(std::lround(255.0f * color[2]), std::lround(expected.mesh.property("blue")->values[v]));
    EXPECT_EQ(color[3], 1.0f);
  }
}

TYPED_TEST(OfOpenMesh, GetsItsCurvature) {
  TypeParam mesh = to_openmesh<TypeParam>(sphere_mesh(2.0, {.n = 12}));
  curvature(mesh);
  const auto directions = values_of<OpenMesh::Vec3d>(mesh, "k1_direction");
  ASSERT_EQ(directions.size(), mesh.n_vertices());
  // Edges are a tenth of the radius: errors of their square.
  for (const double k : values_of<double>(mesh, "k1")) EXPECT_NEAR(k, 0.5, 0.02);
  for (const double k : values_of<double>(mesh, "k2")) EXPECT_NEAR(k, 0.5, 0.02);
  for (const OpenMesh::Vec3d& direction : directions) EXPECT_NEAR(direction.norm(), 1.0, 1e-6);
}

TYPED_TEST(OfOpenMesh, StaysWhatItIsBesides) {
  TypeParam mesh = to_openmesh<TypeParam>(graph_mesh(1.0, {.n = 4}, [](double x, double) { return x * x; }));
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  const OpenMesh::VertexHandle deleted(3);
  const double far = std::numeric_limits<float>::infinity();
  mesh.delete_vertex(deleted, false);
  mesh.set_point(deleted, typename TypeParam::Point(OpenMesh::Vec3d(far, far, far)));
  const PolygonMesh rest = polygon_mesh(mesh);
  EXPECT_LT(rest.face_count(), mesh.n_faces()) << "what is deleted is left out";
  EXPECT_EQ(rest.positions.size() + 1, mesh.n_vertices());
  const auto before = mesh;
  const BakedMesh expected = bake(plan_bake(rest, {}), {}, {});
  EXPECT_EQ(bake(mesh, {}).sigma(), expected.moments.sigma());
  const auto noise = values_of<float>(mesh, "noise");
  EXPECT_TRUE(std::ranges::equal(noise, expected.mesh.property("noise")->values));
  ASSERT_EQ(mesh.n_vertices(), before.n_vertices());
  ASSERT_EQ(mesh.n_faces(), before.n_faces());
  for (const auto vertex : mesh.vertices()) EXPECT_EQ(mesh.point(vertex), before.point(vertex));
}

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<BytesTraits>;

Mesh test_mesh() {
  return to_openmesh<Mesh>(torus_mesh(1.0, 0.4, {.n = 12, .jitter = 0.3}));
}

// The height of each vertex, over 1, as a property.
template <typename Number>
void add_heights(Mesh& mesh, const std::string& name) {
  openmesh::set_property<Number>(mesh, name, [&](std::size_t v) {
    return static_cast<Number>(2.0 + mesh.point(OpenMesh::VertexHandle(static_cast<int>(v)))[1]);
  });
}

TEST(BakeOpenMesh, SteersByAPropertyOfTheCallers) {
  Mesh mesh = test_mesh();
  add_heights<double>(mesh, "heat");
  BakeRecipe recipe;
  recipe.magnitude = {0.5, 2.0};
  recipe.by.source = SteeringSource::attribute;
  recipe.by.attribute = "heat";
  bake(mesh, recipe, {"steering"});
  const auto heat = values_of<double>(mesh, "heat");
  const auto steering = values_of<float>(mesh, "steering");
  ASSERT_EQ(steering.size(), heat.size());
  for (std::size_t v = 0; v < heat.size(); ++v) EXPECT_EQ(steering[v], static_cast<float>(heat[v]));
  recipe.by.attribute = "cold";
  EXPECT_EQ(message_of<std::invalid_argument>([&] { bake(mesh, recipe); }),
            "attribute is cold; the mesh has no vertex property of floats or doubles so named");
}

TEST(BakeOpenMesh, MovesThePointsOfARecipeThatDisplaces) {
  Mesh mesh = test_mesh();
  const Mesh before = mesh;
  BakeRecipe recipe;
  recipe.displace = 0.01;
  bake(mesh, recipe);
  const auto noise = values_of<float>(mesh, "noise");
  for (const auto vertex : mesh.vertices()) {
    const double distance = (mesh.point(vertex) - before.point(vertex)).norm();
    EXPECT_NEAR(distance, 0.01 * std::abs(noise[static_cast<std::size_t>(vertex.idx())]), 1e-6);
    EXPECT_NEAR(mesh.normal(vertex).norm(), 1.0, 1e-6);
  }
}

TEST(BakeOpenMesh, RefusesToRefine) {
  Mesh mesh = test_mesh();
  BakeRecipe recipe;
  recipe.refine.mode = RefineRecipe::Mode::rounds;
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { bake(mesh, recipe); }),
      "refine is on; a mesh that is baked in place keeps its vertices: refine it before, by a subdivider");
}

TEST(BakeNoiseOpenMesh, TakesParametersFromProperties) {
  Mesh mesh = test_mesh();
  add_heights<float>(mesh, "density");
  curvature(mesh);
  SurfaceNoiseRecipe recipe;
  recipe.kind = SurfaceNoiseKind::oriented;
  bake_noise(mesh, recipe, {.frequency = "density", .magnitude = 2.0, .direction = "k1_direction"});

  const PolygonMesh polygons = polygon_mesh(mesh);
  const SurfaceMesh surface(polygons);
  const std::vector<Vec<3>> normals = surface.to_vertices(surface.normals());
  const Curvature measured = measure_curvature(surface);
  const std::vector<float> density = values_of<float>(mesh, "density");
  const double least = *std::min_element(density.begin(), density.end());
  const std::vector<float> expected = bake_noise(
      recipe, {polygons.positions, normals, {least, density}, {1.0, {}}, {2.0, {}}, measured.k1_direction});
  EXPECT_EQ(values_of<float>(mesh, "noise"), expected);

  EXPECT_EQ(message_of<std::invalid_argument>([&] { bake_noise(mesh, recipe, {.direction = "density"}); }),
            "direction is density; the mesh has no vertex property of Vec3f or Vec3d so named");
}

}  // namespace
}  // namespace solidnoise::bake_openmesh_test
