#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::stream_test {
namespace {

using Arguments = std::vector<std::string>;

// 512^3 voxels, which may take 0.6 GB in memory.
Arguments large_volume(const Arguments& more) {
  Arguments arguments{"--raw", "--shape", "sphere", "--dim", "512"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

ToolResult run(const Arguments& more, const TemporaryFolder& folder) {
  return run_vdbnoise(large_volume(more), {.folder = folder.path()});
}

bool is_streamed(const Arguments& more) {
  Arguments arguments = more;
  arguments.insert(arguments.end(), {"--describe"});
  const ToolResult result = run(arguments, {});
  EXPECT_EQ(result.status, 0) << result.err;
  return parse_json(result.out)["cost"]["streamed"].get<bool>();
}

TEST(Streaming, MakesTheSameFileOfWhatWouldNotFit) {
  const TemporaryFolder folder;
  EXPECT_FALSE(is_streamed({"--max-memory", "8G"}));
  EXPECT_TRUE(is_streamed({"--max-memory", "500M"}));
  for (const Arguments& arguments :
       {Arguments{"--max-memory", "8G", "--out", "whole.vdb"},
        Arguments{"--max-memory", "500M", "--out", "streamed.vdb", "--write-recipe", "recipe.json"}}) {
    const ToolResult result = run(arguments, folder);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("513 x 513 x 513"), std::string::npos) << result.err;
  }
  EXPECT_EQ(file_digest(folder.file("whole.vdb")), file_digest(folder.file("streamed.vdb")));
  EXPECT_EQ(folder.count(), 3u);
}

TEST(Streaming, IsNotForWhatNeedsAllValuesAtOnce) {
  const TemporaryFolder folder;
  EXPECT_FALSE(is_streamed({"--max-memory", "500M", "--preview", "x.png"}));
  EXPECT_FALSE(is_streamed({"--max-memory", "500M", "--out", "-"}));
  for (const Arguments& arguments :
       {Arguments{"--out", "x.vdb", "--preview", "x.png"}, Arguments{"--out", "-"}}) {
    Arguments limited = arguments;
    limited.insert(limited.end(), {"--max-memory", "500M"});
    const ToolResult result = run(limited, folder);
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("--max-memory allows 500.0 MiB"), std::string::npos) << result.err;
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Streaming, IsRefusedWhereItDoesNotFitEither) {
  const TemporaryFolder folder;
  const ToolResult result = run({"--max-memory", "300M", "--out", "x.vdb"}, folder);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("--max-memory allows 300.0 MiB"), std::string::npos) << result.err;
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace solidnoise::stream_test
