#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/topology/mesh_level_set.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::mesh_topology_test {
namespace {

TriangleMesh cube(const Vec<3>& lower, const Vec<3>& upper) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions.emplace_back((corner & 1) ? upper.x : lower.x, (corner & 2) ? upper.y : lower.y,
                                (corner & 4) ? upper.z : lower.z);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

Vec<3> unit(const Vec<3>& v) {
  return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

// An octahedron, its triangles halved along each edge `levels` times and put onto the unit sphere.
TriangleMesh sphere(int levels) {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (added) mesh.positions.push_back(unit(mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

// By the divergence theorem: a sixth of the sum of the corners' triple products.
double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec<3>& a = mesh.positions[t[0]];
    const Vec<3>& b = mesh.positions[t[1]];
    const Vec<3>& c = mesh.positions[t[2]];
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return sum / 6.0;
}

Topology mesh_topology(const GridFrame& frame, const TriangleMesh& mesh, Progress* progress = nullptr) {
  return mesh_voxels(frame, mesh, 0.0, progress).topology;
}

TEST(MeshTopology, OfACubeIsTheTopologyOfTheBox) {
  const GridFrame frame(0.1);
  const Box<3> box{{-1.23, 0.41, 2.27}, {0.88, 1.96, 3.02}};  // no face lies on voxel centres
  const Topology mesh = mesh_topology(frame, cube(box.lower, box.upper));
  const Topology expected = box_topology(frame, box);
  EXPECT_TRUE(mesh.mask->hasSameTopology(*expected.mask));
  EXPECT_EQ(mesh.voxel_count(), expected.voxel_count());
}

TEST(MeshTopology, OfASphereHasTheVolumeOfItsPolyhedron) {
  const double voxel = 0.025;
  const TriangleMesh mesh = sphere(4);
  const Topology topology = mesh_topology(GridFrame(voxel), mesh);
  const double measured = static_cast<double>(topology.voxel_count()) * voxel * voxel * voxel;
  // As for the sphere's own topology: 4 pi 40^2 surface voxels, each wrong by a deviation of at most 0.5.
  EXPECT_NEAR(measured / volume(mesh), 1.0, 0.001);
  EXPECT_FALSE(topology.mask->hasActiveTiles());
}

TEST(MeshTopology, IsTheSameFarFromTheOriginAndWithFacesTurnedInward) {
  const GridFrame frame(0.25);
  TriangleMesh mesh = sphere(2);
  const std::uint64_t voxels = mesh_topology(frame, mesh).voxel_count();
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(mesh_topology(frame, mesh).voxel_count(), voxels);
  // 2^22 units are 2^24 voxels: single precision would see two voxels as one.
  for (Vec<3>& position : mesh.positions) position += Vec<3>(4194304.0, -4194304.0, 0.0);
  EXPECT_EQ(mesh_topology(frame, mesh).voxel_count(), voxels);
}

TEST(MeshTopology, CountsVerticesAtEqualPositionsAsOne) {
  TriangleMesh split = cube({-1, -1, -1}, {1, 1, 1});
  TriangleMesh soup;
  for (const auto& triangle : split.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t corner : triangle) soup.positions.push_back(split.positions[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_NO_THROW(require_closed(soup));
  // Nor are those that rounding puts apart.
  for (std::size_t i = 0; i < soup.positions.size(); ++i)
    soup.positions[i].x += 1e-8 * std::sin(7.0 * static_cast<double>(i));
  EXPECT_NO_THROW(require_closed(soup));
  soup.positions[3].x += 1e-3;
  EXPECT_THROW(require_closed(soup), std::invalid_argument);
}

TEST(MeshTopology, RefusesMeshesWithoutAnInside) {
  const auto refusal = [](const TriangleMesh& mesh) {
    return message_of<std::invalid_argument>([&] { mesh_topology(GridFrame(0.1), mesh); });
  };
  EXPECT_NE(refusal({}).find("empty"), std::string::npos);

  TriangleMesh open = cube({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  EXPECT_NE(refusal(open).find("not closed"), std::string::npos) << refusal(open);
  EXPECT_NE(refusal(open).find("3 edges"), std::string::npos) << refusal(open);

  TriangleMesh branching = cube({0, 0, 0}, {1, 1, 1});
  branching.triangles.push_back(branching.triangles.front());
  EXPECT_NE(refusal(branching).find("3 triangles"), std::string::npos) << refusal(branching);

  TriangleMesh degenerate;
  degenerate.positions = {{0, 0, 0}, {1, 1, 1}};
  degenerate.triangles = {{0, 1, 1}};
  EXPECT_NE(refusal(degenerate).find("degenerate"), std::string::npos);

  TriangleMesh broken = cube({0, 0, 0}, {1, 1, 1});
  broken.positions[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(broken).find("not finite"), std::string::npos);
  broken.positions.pop_back();
  EXPECT_NE(refusal(broken).find("not finite"), std::string::npos);

  EXPECT_NE(refusal(cube({0.01, 0.01, 0.01}, {0.09, 0.09, 0.09})).find("no voxel"), std::string::npos);
}

TEST(MeshTopology, IsPlannedFromAnyMeshFile) {
  const TemporaryFolder folder;
  const TriangleMesh expected = cube({-1, 0, 2}, {1, 1, 3});
  PolygonMesh mesh;
  mesh.positions = expected.positions;
  for (const Triangle& triangle : expected.triangles) mesh.add_face(triangle);
  for (const char* name : {"cube.ply", "cube.OBJ", "cube.off", "cube.om"}) {
    write_mesh(folder / name, mesh);
    VolumeRecipe recipe;
    recipe.shape = MeshShape{(folder / name).string()};
    const VolumePlan plan = plan_volume(recipe);
    ASSERT_TRUE(plan.mesh) << name;
    EXPECT_EQ(plan.mesh->positions, expected.positions) << name;
    EXPECT_EQ(plan.mesh->triangles, expected.triangles) << name;
    EXPECT_EQ(plan.box.upper, Vec<3>(1, 1, 3));
  }
}

TEST(MeshTopology, StopsWhenAsked) {
  class Stop final : public Progress {
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(mesh_topology(GridFrame(0.1), sphere(3), &stop), Cancelled);
}

}  // namespace
}  // namespace solidnoise::mesh_topology_test
