#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::agreement_test {
namespace {

constexpr double kVoxel = 0.1;

// A bumpy sheet, all of whose vertices are at corners of a grid with a step of one voxel.
PolygonMesh sheet_on_voxels() {
  PolygonMesh mesh = grid_mesh(30, 30, {Ends::open, Ends::open}, {.n = 30}, [](double u, double v) {
    const double height = std::round(4.0 * std::sin(5.0 * u) * std::cos(4.0 * v));
    return kVoxel * Vec<3>(std::round(30.0 * u) - 15.0, height, std::round(30.0 * v) - 15.0);
  });
  mesh.position_type = ScalarType::float64;
  return mesh;
}

// Both programs evaluate at the same positions, given to within 2^-25 of a cube's side along each axis
// (meshes: floats within cubes of 16 to 32 wavelengths) and 2^-21 of a cell (both; a cell is about a
// wavelength): 2e-6 wavelengths at most. The noise has variance 1 and a band below 1.5 F, hence slopes of
// 2 pi 1.5 / sqrt(3) = 5.5 per wavelength and axis (RMS); five times that along three axes makes 2e-4 for the
// lowest octave. Octave k has positions that are worse and waves that are shorter by 2^k each, and half
// the amplitude: four octaves, 2e-4 (1 + 2 + 4 + 8) before normalising; far fewer in practice.
TEST(Agreement, SolidNoiseOfAMeshIsThatOfAVolume) {
  const struct {
    std::string mesh_noise;
    std::string volume_noise;
    std::vector<std::string> flags;
    double tolerance;
  } cases[] = {
      {"solid", "gabor", {"--frequency", "1.7"}, 2e-4},
      {"solid",
       "gabor",
       {"--frequency", "0.6", "--octaves", "4", "--gain", "0.5", "--bandwidth", "0.8", "--error", "0.05",
        "--seed", "7"},
       3e-3},
      {"kensler-solid", "kensler", {"--frequency", "1.7", "--octaves", "1", "--seed", "3"}, 2e-4},
  };
  for (const auto& each : cases) {
    const TemporaryFolder folder;
    const PolygonMesh sheet = sheet_on_voxels();
    write_sample(folder, "sheet.ply", sheet);
    std::vector<std::string> bake{"bake",    "sheet.ply",     "--out",    "baked.ply",
                                  "--noise", each.mesh_noise, "--preset", "raw"};
    // Vertices are always summed, voxels only where the noise is to be exact.
    std::vector<std::string> make{"--raw",   "--exact", "--out", "noise.vdb", "--noise", each.volume_noise,
                                  "--voxel", "0.1",     "--box", "-1.6",      "-0.6",    "-1.6",
                                  "1.6",     "0.6",     "1.6"};
    bake.insert(bake.end(), each.flags.begin(), each.flags.end());
    make.insert(make.end(), each.flags.begin(), each.flags.end());
    const ToolResult baked = run_meshnoise(bake, {.folder = folder.path()});
    ASSERT_EQ(baked.status, 0) << baked.err;
    const ToolResult made = run_vdbnoise(make, {.folder = folder.path()});
    ASSERT_EQ(made.status, 0) << made.err;

    const std::vector<double> noise = numbers_of(read_mesh(folder.file("baked.ply")).mesh, "noise");
    ASSERT_EQ(noise.size(), sheet.positions.size());
    ASSERT_GT(spread(noise), 1.0);
    const auto grid = read_float_grid(folder.file("noise.vdb"));
    for (std::size_t v = 0; v < noise.size(); ++v) {
      const Vec<3>& p = sheet.positions[v];
      const openvdb::Vec3d index = grid->transform().worldToIndex({p.x, p.y, p.z});
      const openvdb::Coord voxel = openvdb::Coord::round(index);
      ASSERT_LT((index - voxel.asVec3d()).length(), 1e-9) << "the vertex is at no voxel";
      ASSERT_TRUE(grid->tree().isValueOn(voxel)) << voxel;
      ASSERT_NEAR(noise[v], grid->tree().getValue(voxel), each.tolerance)
          << each.mesh_noise << " at " << voxel;
    }
  }
}

}  // namespace
}  // namespace solidnoise::agreement_test
