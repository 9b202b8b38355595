#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::nvdb_test {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class NvdbOutput : public testing::Test {
 protected:
  ToolResult run(std::vector<std::string> arguments) const {
    const ToolResult result = run_vdbnoise(arguments, {.folder = folder_.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }

  TemporaryFolder folder_;
};

TEST_F(NvdbOutput, HasTheValuesOfAVdb) {
  run({"--dim", "24", "--out", "a.vdb", "--quiet"});
  const ToolResult made = run({"--dim", "24", "--out", "a.nvdb"});
  EXPECT_TRUE(contains(made.err, "a.nvdb: has no place for the recipe")) << made.err;
  const auto expected = read_float_grid(folder_.file("a.vdb"));
  const auto read = read_float_grid(folder_.file("a.nvdb"));
  ASSERT_GT(expected->activeVoxelCount(), 100u);
  EXPECT_EQ(read->activeVoxelCount(), expected->activeVoxelCount());
  for (auto value = expected->cbeginValueOn(); value; ++value) {
    ASSERT_EQ(read->tree().getValue(value.getCoord()), *value);
  }
}

TEST_F(NvdbOutput, IsDescribedMeasuredAndChanged) {
  const ToolResult made = run({"--preset", "fire", "--dim", "24", "--nvdb-bits", "8", "--out", "fire.nvdb"});
  EXPECT_TRUE(contains(made.err, "fire.nvdb: grid temperature, in 8 bits: stored values are within "));
  EXPECT_FALSE(contains(made.err, "grid vel, in")) << made.err;
  const std::string info = run({"info", "fire.nvdb"}).out;
  EXPECT_TRUE(contains(info, "grid density: float, fog volume")) << info;
  EXPECT_TRUE(contains(info, "stored_as = 8 bits") && contains(info, "grid vel: vec3s")) << info;
  const auto report = nlohmann::json::parse(run({"analyze", "fire.nvdb", "--grid", "density"}).out);
  EXPECT_GT(report.at("moments").at("variance").get<double>(), 0.0) << report;
  run({"--on", "fire.nvdb:density", "--combine", "add", "--amount", "0", "--out", "same.vdb", "--quiet"});
}

TEST_F(NvdbOutput, IsWithinTheErrorThatIsStated) {
  for (const std::string bits : {"16", "8", "4"}) {
    run({"--dim", "16", "--out", "a.vdb", "--quiet", "--force"});
    const std::string said = run({"--dim", "16", "--nvdb-bits", bits, "--out", "a.nvdb", "--force"}).err;
    const std::string before = "stored values are within ";
    const double stated = std::stod(said.substr(said.find(before) + before.size()));
    const auto expected = read_float_grid(folder_.file("a.vdb"));
    const auto read = read_float_grid(folder_.file("a.nvdb"));
    double error = 0.0;
    for (auto value = expected->cbeginValueOn(); value; ++value) {
      error = std::max(error, std::abs(double{read->tree().getValue(value.getCoord())} - double{*value}));
    }
    EXPECT_LE(error, stated) << bits;
    EXPECT_LE(stated, 1.01 * error) << bits;  // a third digit more
  }
}

TEST_F(NvdbOutput, IsMadeOfFrames) {
  run({"--dim", "12", "--evolve", "1", "--frames", "3-4", "--out", "a.##.nvdb", "--quiet"});
  EXPECT_EQ(folder_.names(), (std::set<std::string>{"a.03.nvdb", "a.04.nvdb"}));
}

TEST_F(NvdbOutput, RefusesWhatItCannotKeep) {
  const std::vector<Refusal> refusals{
      {"Bits", 2, {"--out", "a.vdb", "--nvdb-bits", "8"}, {"--nvdb-bits is of --out FILE.nvdb"}},
      {"OtherBits", 2, {"--out", "a.nvdb", "--nvdb-bits", "7"}, {"--nvdb-bits is 7", "16"}},
      {"Half", 2, {"--out", "a.nvdb", "--half"}, {"--half is of .vdb; --nvdb-bits"}},
      {"Codec", 2, {"--out", "a.nvdb", "--codec", "none"}, {"--codec is of .vdb"}},
      {"Part", 2, {"--out", "a.nvdb", "--shard", "1/2"}, {"--shard needs the recipe in the file"}},
      {"Kept", 2, {"--out", "a.nvdb", "--skip-existing"}, {"--skip-existing needs the recipe"}},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.name);
    std::vector<std::string> arguments{"--dim", "8", "--quiet"};
    arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
    expect_refusal(run_vdbnoise(arguments, {.folder = folder_.path()}), refusal, "vdbnoise");
  }
  EXPECT_EQ(folder_.count(), 0u);
  folder_.write("bad.nvdb", "no NanoVDB");
  const ToolResult result = run_vdbnoise({"info", "bad.nvdb"}, {.folder = folder_.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "bad.nvdb: is not a .nvdb, or damaged")) << result.err;
}

}  // namespace
}  // namespace solidnoise::nvdb_test
