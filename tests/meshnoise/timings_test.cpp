#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "tools/stage_lines.h"

namespace solidnoise::timings_test {
namespace {

TEST(MeshnoiseTimings, ArePrintedStageByStageWhenAskedFor) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", torus_with_numbers());
  const auto printed = [&](const std::vector<std::string>& arguments) {
    const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  EXPECT_EQ(printed({"bake", "in.ply", "--out", "a.ply", "--quiet"}), "");
  EXPECT_EQ(
      stage_names(printed({"bake", "in.ply", "--out", "b.ply", "--quiet", "--timings"})),
      (std::vector<std::string>{"start", "reading", "plan", "noise", "colors", "writing", "end", "all"}));
}

}  // namespace
}  // namespace solidnoise::timings_test
