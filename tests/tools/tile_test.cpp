#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::tile_test {
namespace {

// A tile of 20 voxels, and the box of two tiles along an axis.
constexpr int kSide = 20;
const std::vector<std::vector<std::string>> kNoises{
    {},
    {"--bandwidth", "2", "--error", "0.1"},
    {"--noise", "gabor-oriented", "--anisotropy", "0.6"},
    {"--noise", "kensler"},
    {"--noise", "kensler", "--hash", "integer", "--support", "half"},
    {"--octaves", "3", "--lacunarity", "3"},
    {"--noise", "kensler", "--octaves", "2"},
    {"--evolve", "0.5", "--time", "0.4"},
    {"--dims", "4", "--time", "0.4", "--loop", "3"},
    {"--band-limit", "--octaves", "2"},
    {"--normalize"},
};

openvdb::FloatGrid::Ptr make(const std::vector<std::string>& noise, const std::vector<std::string>& box) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{
      "--raw", "--voxel", "0.1",   "--frequency",           "2",    "--period", "2", "2",
      "2",     "--quiet", "--out", folder.file("tile.vdb"), "--box"};
  arguments.insert(arguments.end(), box.begin(), box.end());
  arguments.insert(arguments.end(), noise.begin(), noise.end());
  const ToolResult result = run_vdbnoise(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return read_float_grid(folder.file("tile.vdb"));
}

TEST(VdbnoiseTiles, AreTheLargerVolumeOverAndOverAlongEveryAxis) {
  for (const auto& noise : kNoises) {
    SCOPED_TRACE(testing::PrintToString(noise));
    const auto tile = make(noise, {"0", "0", "0", "2", "2", "2"});
    ASSERT_EQ(tile->activeVoxelCount(), kSide * kSide * kSide);
    const auto two = make(noise, {"-2", "-2", "-2", "2", "2", "2"});
    ASSERT_EQ(two->activeVoxelCount(), 8 * kSide * kSide * kSide);
    for (auto value = two->cbeginValueOn(); value; ++value) {
      openvdb::Coord wrapped = value.getCoord();
      for (int axis = 0; axis < 3; ++axis) wrapped[axis] = (wrapped[axis] + kSide) % kSide;
      ASSERT_EQ(*value, tile->tree().getValue(wrapped)) << value.getCoord();
    }
    // And no shorter period.
    EXPECT_NE(tile->tree().getValue({kSide / 2, 3, 1}), tile->tree().getValue({0, 3, 1}));
  }
}

TEST(VdbnoiseTiles, APeriodThatIsNotWholeVoxelsIsWarnedOf) {
  const TemporaryFolder folder;
  const ToolResult odd = run_vdbnoise({"--raw", "--voxel", "0.15", "--frequency", "2", "--period", "0", "2",
                                       "0", "--out", folder.file("a.vdb")});
  EXPECT_EQ(odd.status, 0) << odd.err;
  EXPECT_NE(odd.err.find("the period is 2 along y, 13.3333 voxels"), std::string::npos) << odd.err;
  EXPECT_NE(odd.err.find("--voxel 0.153846"), std::string::npos) << odd.err;
  const ToolResult whole = run_vdbnoise({"--raw", "--voxel", "0.1", "--frequency", "2", "--period", "0", "2",
                                         "0", "--out", folder.file("b.vdb")});
  EXPECT_EQ(whole.err.find("warning"), std::string::npos) << whole.err;
}

// A third has no end of digits.
TEST(VdbnoiseTiles, TheVoxelThatTheWarningNamesIsNotWarnedOf) {
  const TemporaryFolder folder;
  const auto warning = [&](const std::string& voxel, const std::string& file) {
    return run_vdbnoise({"--raw", "--voxel", voxel, "--frequency", "0.8", "--period", "0", "5", "0", "--out",
                         folder.file(file)})
        .err;
  };
  const std::string odd = warning("0.34", "a.vdb");
  const std::size_t named = odd.find("--voxel ");
  ASSERT_NE(named, std::string::npos) << odd;
  const std::size_t begin = named + std::string("--voxel ").size();
  const std::string followed = warning(odd.substr(begin, odd.find_first_of("\n", begin) - begin), "b.vdb");
  EXPECT_EQ(followed.find("period"), std::string::npos) << followed;
}

}  // namespace
}  // namespace solidnoise::tile_test
