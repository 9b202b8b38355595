#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "tools/expect_estimate.h"

namespace solidnoise::limits_test {
namespace {

TEST(MeshnoiseEstimatedMemory, IsWhatABakeTakes) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(44));
  const auto run = [&](const std::vector<std::string>& arguments) {
    return run_meshnoise(arguments, {.folder = folder.path()});
  };
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--noise", "surface", "--octaves", "4", "--detail", "0.5..1.8"},
        {"--noise", "oriented", "--impulses", "5000"},
        {"--refine", "3"},
        {"--preset", "bark", "--refine", "3"},
        {"--refine", "auto", "--frequency", "8"}}) {
    std::vector<std::string> command{"bake", "in.ply"};
    command.insert(command.end(), options.begin(), options.end());
    expect_estimate(run, command, {"--force", "--out", "x.ply"});
  }
  // Where smoothing takes most.
  write_sample(folder, "fine.ply", sample_torus(300));
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--noise", "solid"},
                                                  {"--noise", "surface"},
                                                  {"--noise", "oriented", "--follow", "max-curvature"}}) {
    std::vector<std::string> command{"bake", "fine.ply", "--octaves", "1", "--frequency", "2"};
    command.insert(command.end(), options.begin(), options.end());
    expect_estimate(run, command, {"--force", "--out", "x.ply"});
  }
}

TEST(MeshnoiseEstimatedMemory, IsWhatCurvatureTakes) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(200));
  const auto run = [&](const std::vector<std::string>& arguments) {
    return run_meshnoise(arguments, {.folder = folder.path()});
  };
  expect_limits(run, {"curvature", "in.ply", "--out", "x.ply", "--force"});
  expect_limits(run, {"curvature", "in.ply", "--preview", "x.png", "--force"});
}

TEST(MeshnoiseLimits, CountTheImpulsesOfVerticesThatShareNone) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(200));
  const auto seconds = [&](const std::string& frequency) {
    const ToolResult run =
        run_meshnoise({"bake", "in.ply", "--preset", "raw", "--noise", "solid", "--octaves", "1",
                       "--frequency", frequency, "--describe", "--quiet"},
                      {.folder = folder.path()});
    return nlohmann::json::parse(run.out).at("cost").at("seconds_of_one_core").get<double>();
  };
  const double together = seconds("2");
  const double alone = seconds("2000");
  EXPECT_GT(alone, 4.0 * together);
  EXPECT_NEAR(alone, seconds("20000"), 0.1 * alone);
}

// A strip of slivers, whose long edges reach over many waves, while neighbours see the same impulses.
TEST(MeshnoiseLimits, TakeSliversForTheNeighboursThatTheyAre) {
  const TemporaryFolder folder;
  PolygonMesh strip;
  constexpr std::uint32_t kRows = 20000;
  for (std::uint32_t i = 0; i < kRows; ++i) {
    for (const double y : {0.0, 1.0}) strip.positions.push_back({1e-4 * i, y, 0.0});
    if (i + 1 == kRows) break;
    const std::uint32_t first = 2 * i;
    strip.add_face(std::array{first, first + 2, first + 1});
    strip.add_face(std::array{first + 1, first + 2, first + 3});
  }
  write_sample(folder, "strip.ply", strip);
  const ToolResult described = run_meshnoise(
      {"bake", "strip.ply", "--frequency", "200", "--octaves", "4", "--describe"}, {.folder = folder.path()});
  ASSERT_EQ(described.status, 0) << described.err;
  EXPECT_LT(nlohmann::json::parse(described.out)["cost"]["seconds_of_one_core"].get<double>(), 2.0);
}

TEST(MeshnoiseLimits, AreHeldToBeforeWork) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(44));
  const ToolResult time = run_meshnoise(
      {"bake", "in.ply", "--impulses", "20000", "--refine", "2", "--max-time", "0.5", "--out", "x.ply"},
      {.folder = folder.path()});
  EXPECT_EQ(time.status, 1);
  EXPECT_NE(time.err.find(" seconds, --max-time allows 0.5"), std::string::npos) << time.err;
  const ToolResult memory =
      run_meshnoise({"bake", "in.ply", "--max-memory", "10M", "--out", "x.ply"}, {.folder = folder.path()});
  EXPECT_EQ(memory.status, 1);
  EXPECT_NE(memory.err.find("--max-memory allows 10.0 MiB"), std::string::npos) << memory.err;
  EXPECT_EQ(folder.names(), std::set<std::string>{"in.ply"});
}

TEST(MeshnoiseDisplace, FartherThanTheMeshIsLongIsWarnedOf) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus(44));
  const auto warning = [&](const char* displace) {
    const ToolResult result = run_meshnoise(
        {"bake", "in.ply", "--preset", "stone", "--displace", displace, "--force", "--out", "x.ply"},
        {.folder = folder.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err.find("meshnoise: warning: --displace moves vertices by up to ") != std::string::npos;
  };
  EXPECT_TRUE(warning("5"));
  EXPECT_FALSE(warning("0.02"));
}

}  // namespace
}  // namespace solidnoise::limits_test
