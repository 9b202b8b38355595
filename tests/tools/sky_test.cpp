// vdbnoise sky: the files that it makes, and what it refuses.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/sky/points_file.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "support/temporary_folder.h"
#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::sky_test {
namespace {

std::vector<std::string> sky(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"sky", "--count", "14", "--kinds", "4", "--voxel", "80"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Sky, MakesAFileOfEachCloudAndASceneOfThem) {
  const TemporaryFolder folder;
  const ToolResult result = run_vdbnoise(
      sky({"--out", "s.usda", "--write-points", "s.csv", "--lod-from", "0", "0", "0", "--lod-angle", "2"}),
      {.folder = folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(folder.names(), (std::set<std::string>{"s", "s.csv", "s.usda"}));
  const std::string points = folder.read("s.csv");
  EXPECT_EQ(std::count(points.begin(), points.end(), '\n'), 15);
  EXPECT_EQ(read_points(folder / "s.csv").size(), 14u);
  const std::string scene = folder.read("s.usda");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "s")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".usda") {
      EXPECT_NE(scene.find("@./s/" + name + "@"), std::string::npos) << name;
      continue;
    }
    EXPECT_NE(points.find("s/" + name), std::string::npos) << name;
    EXPECT_GT(read_float_grid(entry.path(), "density")->activeVoxelCount(), 0u);
    ++files;
  }
  EXPECT_GE(files, 4u);
}

TEST(Sky, KeepsWhatIsWholeAndMakesTheRest) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_vdbnoise(sky({"--out", "s.usda", "--quiet"}), {.folder = folder.path()}).status, 0);
  const auto kept = folder / "s/cloud_000_0.vdb";
  const auto lost = folder / "s/cloud_001_0.vdb";
  const auto time = std::filesystem::last_write_time(kept);
  const std::uintmax_t size = std::filesystem::file_size(lost);
  std::filesystem::resize_file(lost, size / 2);
  const ToolResult again =
      run_vdbnoise(sky({"--out", "s.usda", "--skip-existing"}), {.folder = folder.path()});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(kept), time);
  EXPECT_EQ(std::filesystem::file_size(lost), size);
}

TEST(Sky, IsOneGridThatCarriesItsRecipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_vdbnoise(sky({"--out", "one.vdb", "--quiet"}), {.folder = folder.path()}).status, 0);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"one.vdb"}));
  const ToolResult again =
      run_vdbnoise({"sky", "--recipe", "one.vdb", "--out", "two.vdb", "--quiet", "--threads", "1"},
                   {.folder = folder.path()});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(folder.read("one.vdb").size(), folder.read("two.vdb").size());
  const auto one = read_float_grid(folder / "one.vdb", "density");
  const auto two = read_float_grid(folder / "two.vdb", "density");
  auto values = two->getConstAccessor();
  ASSERT_EQ(one->activeVoxelCount(), two->activeVoxelCount());
  for (auto voxel = one->cbeginValueOn(); voxel; ++voxel)
    ASSERT_EQ(values.getValue(voxel.getCoord()), *voxel);
}

TEST(Sky, WarnsOfCloudsThatAreEmpty) {
  const TemporaryFolder folder;
  const ToolResult result = run_vdbnoise({"sky", "--count", "3", "--voxel", "150", "--kinds", "2",
                                          "--lod-from", "1000", "1000", "1000", "--out", "s.usda"},
                                         {.folder = folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find(" clouds, the first of them cloud_"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(", are empty: no voxel has a density"), std::string::npos) << result.err;
}

TEST(Sky, SaysBeforeWorkWhatItWouldTake) {
  const TemporaryFolder folder;
  const ToolResult described = run_vdbnoise(sky({"--describe"}), {.folder = folder.path()});
  EXPECT_EQ(described.status, 0) << described.err;
  EXPECT_NE(described.out.find("\"memory_bytes\""), std::string::npos);
  EXPECT_EQ(folder.count(), 0u);
  const ToolResult small =
      run_vdbnoise(sky({"--out", "s.usda", "--max-memory", "10M"}), {.folder = folder.path()});
  expect_refusal(small, {"memory", 1, {}, {"a sky of", "may need", "--max-memory allows 10"}},
                 "vdbnoise sky");
  const ToolResult slow =
      run_vdbnoise(sky({"--out", "s.usda", "--max-time", "1e-3"}), {.folder = folder.path()});
  expect_refusal(slow, {"time", 1, {}, {"seconds", "--max-time"}}, "vdbnoise sky");
  EXPECT_EQ(folder.count(), 0u);
}

class SkyRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(SkyRefusal, IsOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("far.csv", "x,y,z\n0,0,0\n1,2,1e300\n");
  folder.write("nan.csv", "x,y,z,size\n1,2,3,nan\n");
  folder.write(
      "two.json",
      R"({"solidnoise": 2, "cloud": {"noise": {"type": "gabor", "bandwidth": -1}}, "points": {"type": "scattered"}})");
  folder.write("s.vdb", "");
  const std::size_t before = folder.count();
  const ToolResult result = run_vdbnoise(GetParam().arguments, {.folder = folder.path()});
  expect_refusal(result, GetParam(), "vdbnoise sky");
  EXPECT_EQ(folder.count(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Sky, SkyRefusal,
    testing::Values(
        Refusal{"PointsOfACommaInNames",
                2,
                {"sky", "--out", "a,b.usda", "--write-points", "p.csv"},
                {"--out is a,b.usda", "--write-points"}},
        Refusal{"NoOutput", 2, {"sky"}, {"--out is missing"}},
        Refusal{"AnotherFormat", 2, {"sky", "--out", "s.nvdb"}, {"--out is s.nvdb", ".usda or .vdb"}},
        Refusal{
            "Exists", 1, {"sky", "--out", "s.vdb", "--voxel", "100"}, {"s.vdb exists; --force replaces it"}},
        Refusal{"FarPoint",
                1,
                {"sky", "--points", "far.csv", "--out", "t.vdb"},
                {"far.csv:3: column 3: z is 1e+300"}},
        Refusal{"NanSize",
                1,
                {"sky", "--points", "nan.csv", "--out", "t.vdb"},
                {"nan.csv:2: column 4: size is nan"}},
        Refusal{"NoFile", 1, {"sky", "--points", "no.csv", "--out", "t.vdb"}, {"no.csv: cannot be read"}},
        Refusal{"ManyPoints",
                2,
                {"sky", "--count", "10000000", "--out", "t.vdb"},
                {"--count is 10000000", "100000"}},
        Refusal{"NoRoom",
                2,
                {"sky", "--spacing", "900", "--out", "t.vdb"},
                {"count is 500; there is room for 1 "}},
        Refusal{"ScatterOfAFile",
                2,
                {"sky", "--points", "nan.csv", "--count", "3", "--out", "t.vdb"},
                {"--count does not apply", "--points"}},
        Refusal{"RegionOfInstances",
                2,
                {"sky", "--region", "0", "0", "0", "1", "1", "1", "--out", "t.usda"},
                {"--region", "--out FILE.vdb"}},
        Refusal{"LevelsOfAGrid", 2, {"sky", "--lod-from", "0", "0", "0", "--out", "t.vdb"}, {"--lod-from"}},
        Refusal{
            "AngleAlone", 2, {"sky", "--lod-angle", "1", "--out", "t.usda"}, {"--lod-angle", "--lod-from"}},
        Refusal{"SeveralGrids",
                2,
                {"sky", "--cloud", "fire", "--out", "t.vdb", "--voxel", "200"},
                {"cloud makes several grids"}},
        Refusal{"BadRecipe",
                1,
                {"sky", "--recipe", "two.json", "--out", "t.vdb"},
                {"two.json", "cloud.noise.bandwidth"}},
        Refusal{"UnknownPreset",
                2,
                {"sky", "--preset", "smoke", "--out", "t.vdb"},
                {"--preset", "cumulus_field"}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace solidnoise::sky_test
