#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::flags_test {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Help, IsAPageAndHasTheRestByGroupOrByWord) {
  const std::string page = run_vdbnoise({"--help"}).out;
  EXPECT_LT(std::count(page.begin(), page.end(), '\n'), 40);
  EXPECT_TRUE(contains(page, "--out FILE.vdb") && contains(page, "--help-all")) << page;
  EXPECT_FALSE(contains(page, "--boundary-width"));

  const std::string all = run_vdbnoise({"--help-all"}).out;
  EXPECT_TRUE(contains(all, "--boundary-width UNITS") && contains(all, "\nDensity:\n")) << all;

  const std::string found = run_vdbnoise({"--help", "LACUNAR"}).out;
  EXPECT_TRUE(found.starts_with("  --lacunarity ")) << found;
  expect_refusal(run_vdbnoise({"--help", "zebra"}), {"", 2, {}, {"--help is zebra"}}, "vdbnoise");
}

// The default that a flag has is that of what it changes.
TEST(Help, TellsTheDefaultsOfThePresetThatIsNamed) {
  EXPECT_TRUE(contains(run_vdbnoise({"--help", "seed"}).out, "(default 2)"));
  EXPECT_TRUE(contains(run_vdbnoise({"--preset", "marble", "--help", "seed"}).out, "(default 3)"));
  EXPECT_TRUE(contains(run_vdbnoise({"--raw", "--help", "frequency"}).out, "(default 8)"));
}

TEST(Completion, IsOfCommandsFlagsAndWords) {
  const auto completed = [](const std::vector<std::string>& words) {
    const ToolResult result = run_vdbnoise(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  EXPECT_EQ(completed({"--complete", "s"}), "surface\nslice\nsky\n");
  EXPECT_EQ(completed({"--complete", "--see"}), "--seed  Another seed makes another noise\n");
  EXPECT_TRUE(completed({"--complete", ""}).starts_with("make\nmerge\n"));
  EXPECT_TRUE(contains(completed({"--complete", ""}), "\n--seed  "));  // it takes nothing but flags
  EXPECT_EQ(completed({"info", "--complete", ""}), "");                // a file
  EXPECT_EQ(completed({"--dims", "2", "--complete", "--dims"}), "");   // is given
  EXPECT_EQ(completed({"--shape", "--complete", ""}), "box\nsphere\nellipsoid\n");
  EXPECT_EQ(completed({"slice", "--preset", "--complete", "f"}), "fire\n");
  EXPECT_EQ(completed({"--seed", "--complete", ""}), "");
  expect_refusal(run_vdbnoise({"--complete"}), {"", 2, {}, {"--complete is not a flag"}}, "vdbnoise");
}

TEST(Commands, ThatAreMistypedAreSuggested) {
  expect_refusal(run_vdbnoise({"analize", "x.vdb"}), {"", 2, {}, {"analize is no command", "mean analyze?"}},
                 "vdbnoise");
}

TEST(Curves, AreOfFramesAndOfNumbersInTheirRange) {
  const std::vector<Refusal> refusals{
      {"WithoutFrames", 2, {"--density", "0:1,9:2"}, {"--density is 0:1,9:2, a curve", "give --frames"}},
      {"OutOfRangeAtAKey", 2, {"--octaves", "0:1,9:99", "--frames", "0-1"}, {"--octaves is 99"}},
      {"KeysBackwards", 2, {"--density", "9:1,0:2", "--frames", "0-1"}, {"--density is 9:1,0:2"}},
      {"HalfAKey", 2, {"--density", "0:1,9", "--frames", "0-1"}, {"--density is 0:1,9; it must be"}},
      {"NotOfTheRun", 2, {"--threads", "0:1,9:2", "--frames", "0-1"}, {"--threads is 0:1,9:2"}},
      {"NotOfARate", 2, {"--evolve", "0:1,9:2", "--frames", "0-1"}, {"--evolve is 0:1,9:2"}},
      {"AndARecipe",
       2,
       {"--density", "0:1,9:2", "--frames", "0-1", "--write-recipe", "r.json"},
       {"--write-recipe is of one volume"}},
  };
  const TemporaryFolder folder;
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.name);
    std::vector<std::string> arguments{"--out", "x.#.vdb", "--dim", "8", "--quiet"};
    arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
    expect_refusal(run_vdbnoise(arguments, {.folder = folder.path()}), refusal, "vdbnoise");
  }
  EXPECT_TRUE(folder.names().empty());
}

// Flags of numbers are checked by the table's range before anything is looked up far away.
TEST(Ranges, OfFlagsAreNamedByTheFlag) {
  for (const auto& [flag, values] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{{"--offset", {"1e30", "0", "0"}},
                                                                     {"--warp", {"1e30"}},
                                                                     {"--size", {"1e300"}},
                                                                     {"--wind", {"0", "1e30", "0"}}}) {
    std::vector<std::string> arguments{"--raw", "--out", "x.vdb", "--dim", "8", flag};
    arguments.insert(arguments.end(), values.begin(), values.end());
    expect_refusal(run_vdbnoise(arguments), {"", 2, {}, {flag + " is 1", "between"}}, "vdbnoise");
  }
  expect_refusal(run_vdbnoise({"--edge", "1e30", "--shape", "sphere", "--out", "x.vdb"}),
                 {"", 2, {}, {"--edge is 1", "between 0"}}, "vdbnoise");
  expect_refusal(run_vdbnoise({"--edge", "1", "--edge-voxels", "2", "--shape", "sphere", "--out", "x.vdb"}),
                 {"", 2, {}, {"--edge", "--edge-voxels"}}, "vdbnoise");
}

// A run of vdbnoise that is given a file of the folder through a pipe.
ToolResult pipe(const std::string& file, const std::string& arguments, const TemporaryFolder& folder) {
  const std::string command = "cat " + file + " | " + in_build("tools/vdbnoise") + " " + arguments;
  return RunningTool("/bin/sh", {"-c", command}, {.folder = folder.path()}).wait();
}

TEST(StandardInput, IsAVolume) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_vdbnoise({"--raw", "--dim", "12", "--quiet", "--out", folder.file("a.vdb")}).status, 0);
  const auto piped = [&](const std::string& arguments) { return pipe("a.vdb", arguments, folder); };
  const ToolResult info = piped("info -");
  EXPECT_TRUE(contains(info.out, "grid density: float")) << info.err;
  EXPECT_EQ(piped("--on - --combine add --out b.vdb --quiet").status, 0);
  EXPECT_EQ(piped("--on -:nothing --out c.vdb").status, 1);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.vdb", "b.vdb"}));
}

TEST(StandardInput, IsARecipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      run_vdbnoise({"--raw", "--dim", "12", "--seed", "7", "--write-recipe", folder.file("a.json")}).status,
      0);
  EXPECT_EQ(pipe("a.json", "--recipe - --out b.vdb --quiet", folder).status, 0);
  EXPECT_TRUE(contains(run_vdbnoise({"info", folder.file("b.vdb")}).out, "\"seed\": 7"));
  EXPECT_TRUE(contains(pipe("b.vdb", "--recipe - --out c.vdb", folder).err, "vdbnoise: -: "));
}

}  // namespace
}  // namespace solidnoise::flags_test
