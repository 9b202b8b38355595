// What outputs are called: their endings, inputs that they are, and what a terminal makes of their names.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tools/run_vdbnoise.h"

namespace solidnoise::output_names_test {
namespace {

TEST(VdbnoiseOutputNames, MayHaveItsEndingInCapitals) {
  const TemporaryFolder folder;
  const auto run = [&](const std::vector<std::string>& arguments) {
    return run_vdbnoise(arguments, {.folder = folder.path()});
  };
  ASSERT_EQ(run({"--raw", "--dim", "12", "--out", "A.VDB", "--preview", "A.PNG"}).status, 0);
  ASSERT_EQ(run({"--raw", "--shape", "A.VDB:density", "--out", "B.NVDB"}).status, 0);
  ASSERT_EQ(run({"slice", "A.VDB", "--out", "S.EXR"}).status, 0);
  EXPECT_EQ(run({"--recipe", "A.VDB", "--write-recipe", "R.JSON", "--out", "C.vdb"}).status, 0);
  EXPECT_EQ(run({"info", "B.NVDB"}).status, 0);
}

TEST(VdbnoiseOutputNames, IsNoInputButTheGridThatItChanges) {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--force", "--quiet"});
    return run_vdbnoise(arguments, {.folder = folder.path()});
  };
  ASSERT_EQ(run({"--preset", "smoke", "--dim", "12", "--out", "in.vdb"}).status, 0);
  const std::string before = folder.read("in.vdb");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--raw", "--shape", "in.vdb", "--out", "in.vdb"},
        {"--raw", "--dim", "12", "--frequency-grid", "in.vdb", "--frequency-map", "0", "1", "2", "4", "--out",
         "./in.vdb"}}) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("in.vdb is an input, which this output would replace"), std::string::npos)
        << result.err;
    EXPECT_EQ(folder.read("in.vdb"), before);
  }
  EXPECT_EQ(run({"--on", "in.vdb", "--out", "in.vdb"}).status, 0);
  EXPECT_NE(folder.read("in.vdb"), before);
}

// An input that a link with another ending leads to, be it a recipe, a noise or a volume.
TEST(VdbnoiseOutputNames, IsNoInputOfAnotherKindThroughALink) {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--force", "--quiet"});
    return run_vdbnoise(arguments, {.folder = folder.path()});
  };
  ASSERT_EQ(run({"--raw", "--dim", "12", "--out", "in.vdb", "--write-recipe", "in.json"}).status, 0);
  for (const char* input : {"in.vdb", "in.json"}) {
    for (const char* ending : {".png", ".vdb", ".nvdb", ".json"})
      std::filesystem::create_symlink(input, folder.file(std::string(input) + ending));
  }
  const std::string volume = folder.read("in.vdb");
  const std::string recipe = folder.read("in.json");
  for (const std::vector<std::string>& arguments : {
           std::vector<std::string>{"slice", "--recipe", "in.json", "--resolution", "16", "--out",
                                    "in.json.png"},
           {"slice", "in.vdb", "--resolution", "16", "--out", "in.vdb.png"},
           {"--recipe", "in.json", "--dim", "12", "--out", "in.json.vdb"},
           {"--recipe", "in.vdb", "--dim", "12", "--out", "x.vdb", "--preview", "in.vdb.png"},
           {"--recipe", "in.vdb", "--dim", "12", "--write-recipe", "in.vdb.json"},
           {"--on", "in.vdb", "--raw", "--out", "in.vdb.nvdb"},
       }) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_NE(result.err.find("is an input, which this output would replace"), std::string::npos)
        << result.err;
    EXPECT_EQ(folder.read("in.vdb"), volume) << result.err;
    EXPECT_EQ(folder.read("in.json"), recipe) << result.err;
  }
  EXPECT_EQ(run({"--recipe", "in.json", "--frequency", "3", "--write-recipe", "in.json"}).status, 0);
}

// What a name could do to a terminal it does to none.
TEST(VdbnoiseOutputNames, ShowsNoControlCharacters) {
  const TemporaryFolder folder;
  const auto make = [&](const std::string& name) {
    return run_vdbnoise({"--raw", "--dim", "12", "--grid", name, "--out", "x.vdb"},
                        {.folder = folder.path()});
  };
  const ToolResult refused = make("a\x1b[31mz");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("it must have no control character"), std::string::npos) << refused.err;
  const std::string name = "z\xc2\x9b\xe2\x80\xae" + std::string(300, 'y');
  const ToolResult made = make(name);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.err.find(std::string(100, 'y')), std::string::npos) << made.err;
  const ToolResult analyzed = run_vdbnoise({"analyze", folder.file("x.vdb")});
  ASSERT_EQ(analyzed.status, 0) << analyzed.err;
  for (const std::string& text : {refused.err, made.err, analyzed.out}) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.find("\xc2\x9b"), std::string::npos);
    EXPECT_EQ(text.find("\xe2\x80\xae"), std::string::npos);
  }
  EXPECT_EQ(nlohmann::json::parse(analyzed.out)["grid"], name);
}

TEST(VdbnoiseOutputNames, HasANameThatScenesAndJobsCanHold) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::vector<std::string>& arguments) {
    const ToolResult result = run_vdbnoise(arguments, {.folder = folder.path()});
    EXPECT_NE(result.status, 0);
    EXPECT_TRUE(folder.names().empty());
    return result.err;
  };
  const std::string name = "a\ntouch PWNED\n#b.vdb";
  EXPECT_NE(refusal({"--raw", "--dim", "12", "--usd", "--out", name}).find("control characters"),
            std::string::npos);
  EXPECT_NE(
      refusal({"farm", "--raw", "--dim", "12", "--parts", "2", "--out", name}).find("control characters"),
      std::string::npos);
}

}  // namespace
}  // namespace solidnoise::output_names_test
