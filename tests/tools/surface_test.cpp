// Level sets of meshes, through the real program.
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::surface_test {
namespace {

constexpr double kRing = 1.0;  // radii of the torus, in the plane y = 0
constexpr double kTube = 0.4;
constexpr int kSides = 64;

std::string torus_obj() {
  std::string text;
  const double turn = 2.0 * std::numbers::pi / kSides;
  for (int i = 0; i < kSides; ++i) {
    for (int j = 0; j < kSides; ++j) {
      const double r = kRing + kTube * std::cos(turn * j);
      text += "v " + std::to_string(r * std::cos(turn * i)) + ' ' +
              std::to_string(kTube * std::sin(turn * j)) + ' ' + std::to_string(r * std::sin(turn * i)) +
              '\n';
    }
  }
  const auto vertex = [](int i, int j) { return std::to_string(i % kSides * kSides + j % kSides + 1); };
  for (int i = 0; i < kSides; ++i) {
    for (int j = 0; j < kSides; ++j) {
      text += "f " + vertex(i, j) + ' ' + vertex(i, j + 1) + ' ' + vertex(i + 1, j + 1) + ' ' +
              vertex(i + 1, j) + '\n';
    }
  }
  return text;
}

TEST(Surface, HoldsTheDistanceToTheMesh) {
  const TemporaryFolder folder;
  folder.write("torus.obj", torus_obj());
  const ToolResult result = run_vdbnoise(
      {"surface", "torus.obj", "--voxel", "0.05", "--band", "0.3", "--grid", "ring", "--out", "torus.vdb"},
      {.folder = folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto grid = read_float_grid(folder.file("torus.vdb"), "ring");
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_FLOAT_EQ(grid->background(), 0.3f);
  // Faces lie inside of the torus by a chord's height, r (1 - cos(pi / 64)), and fold by as much. Six voxels
  // from the surface OpenVDB takes a face for the closest one that is a few thousandths farther.
  const double chord = (kRing + kTube) * (1.0 - std::cos(std::numbers::pi / kSides));
  std::size_t inside = 0;
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const openvdb::Vec3d p = grid->indexToWorld(value.getCoord());
    const double distance = std::hypot(std::hypot(p.x(), p.z()) - kRing, p.y()) - kTube;
    ASSERT_NEAR(*value, distance, 2.0 * chord + 0.2 * 0.05) << value.getCoord();
    ASSERT_LT(std::abs(*value), 0.3 + 1e-6);
    inside += *value < 0.0f;
  }
  // The volume between the surface and 0.3 below it, 2 pi^2 (0.4^2 - 0.1^2); within a few percent of it.
  const double volume = 2.0 * std::pow(std::numbers::pi, 2) * (0.16 - 0.01);
  EXPECT_NEAR(static_cast<double>(inside) * std::pow(0.05, 3), volume, 0.03 * volume);
  const auto value_at = [&](double x) {
    return grid->tree().getValue(openvdb::Coord::round(grid->worldToIndex(openvdb::Vec3d(x, 0.0, 0.0))));
  };
  EXPECT_EQ(value_at(kRing), -0.3f);  // in the middle of the tube
  EXPECT_EQ(value_at(0.0), 0.3f);
}

TEST(Surface, CanBeDisplaced) {
  const TemporaryFolder folder;
  folder.write("torus.obj", torus_obj());
  EXPECT_EQ(run_vdbnoise({"surface", "torus.obj", "--dim", "48", "--quiet", "--out", "torus.vdb"},
                         {.folder = folder.path()})
                .status,
            0);
  const ToolResult result =
      run_vdbnoise({"--on", "torus.vdb", "--displace", "0.02", "--frequency", "2", "--out", "rock.vdb"},
                   {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
}

class BadSurface : public testing::TestWithParam<Refusal> {};

TEST_P(BadSurface, IsRefusedInOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("torus.obj", torus_obj());
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n");
  const std::set<std::string> before = folder.names();
  expect_refusal(run_vdbnoise(GetParam().arguments, {.folder = folder.path()}), GetParam(),
                 "vdbnoise surface");
  EXPECT_EQ(folder.names(), before);
}

const Refusal kRefusals[] = {
    {"NoMesh", 2, {"surface", "--out", "x.vdb"}, {"MESH"}},
    {"NoOutput", 2, {"surface", "torus.obj"}, {"--out is missing"}},
    {"NoFile", 1, {"surface", "none.obj", "--out", "x.vdb"}, {"none.obj"}},
    {"Open", 1, {"surface", "open.obj", "--out", "x.vdb"}, {"open.obj"}},
    {"ThinBand",
     2,
     {"surface", "torus.obj", "--voxel", "0.1", "--band", "0.2", "--out", "x.vdb"},
     {"--band is 0.2; it must be between 0.3", "world units, 3 to 1000 voxels"}},
    {"NegativeVoxel", 2, {"surface", "torus.obj", "--voxel", "-1", "--out", "x.vdb"}, {"--voxel"}},
    {"TooLarge",
     1,
     {"surface", "torus.obj", "--dim", "2000", "--max-memory", "100M", "--out", "x.vdb"},
     {"the level set may need", "--max-memory allows 100.0 MiB; make --dim or --band smaller"}},
    {"NoVoxels", 2, {"surface", "torus.obj", "--dim", "0", "--out", "x.vdb"}, {"--dim is 0"}},
};

INSTANTIATE_TEST_SUITE_P(Vdbnoise, BadSurface, testing::ValuesIn(kRefusals),
                         [](const auto& refusal) { return refusal.param.name; });

}  // namespace
}  // namespace solidnoise::surface_test
