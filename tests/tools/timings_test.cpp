#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/run_vdbnoise.h"
#include "tools/stage_lines.h"

namespace solidnoise::timings_test {
namespace {

using Names = std::vector<std::string>;

// What a run prints that prints nothing else.
std::string printed(const TemporaryFolder& folder, const Names& more) {
  Names arguments{"--raw", "--dim", "24", "--force", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "");
  return result.err;
}

TEST(VdbnoiseTimings, ArePrintedStageByStageWhenAskedFor) {
  const TemporaryFolder folder;
  EXPECT_EQ(printed(folder, {"--out", "a.vdb"}), "");
  EXPECT_EQ(stage_names(printed(folder, {"--out", "a.vdb", "--timings"})),
            (Names{"start", "plan", "noise", "tree", "writing", "end", "all"}));
  EXPECT_EQ(stage_names(printed(folder, {"--out", "a.vdb", "--preview", "a.png", "--timings"})),
            (Names{"start", "plan", "noise", "tree", "preview", "writing", "end", "all"}));
}

TEST(VdbnoiseTimings, OfASequenceAreThoseOfAllFrames) {
  const TemporaryFolder folder;
  const Names names =
      stage_names(printed(folder, {"--dims", "4", "--frames", "1-3", "--out", "a.##.vdb", "--timings"}));
  EXPECT_EQ(names, (Names{"start", "plan", "noise", "tree", "writing", "end", "all"}));
}

}  // namespace
}  // namespace solidnoise::timings_test
