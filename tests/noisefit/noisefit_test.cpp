#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "noisefit/run_noisefit.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/json.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace solidnoise::noisefit_test {
namespace {

ExemplarModel model_in(const TemporaryFolder& folder, const std::string& name) {
  return exemplar_file_from_json(parse_json(folder.read(name)));
}

TEST(Noisefit, MakesAModelAndASheet) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(48, 40));
  const RunOptions there{.folder = folder.path()};
  const ToolResult result = run_noisefit(
      {"in.png", "--out", "out.json", "--preview", "sheet.png", "--pixel-size", "0.25", "--linear-light"},
      there);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("48 x 40 pixels"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("independent"), std::string::npos) << result.err;
  const ExemplarModel model = model_in(folder, "out.json");
  EXPECT_EQ(model.channels.size(), 3u);
  EXPECT_FALSE(model.raw_values);
  // Frequencies are cycles per unit, up to 0.5 per pixel: 2 per unit.
  double highest = 0.0;
  for (const SpectrumBand& band : model.channels[0].bands) {
    for (const SpectrumComponent& component : band.components) {
      highest = std::max(highest, std::abs(component.frequency.x));
    }
  }
  EXPECT_GT(highest, 0.3);
  EXPECT_LE(highest, 2.0);
  // Four panels of the exemplar, five times enlarged (to 200 pixels at least), and margins.
  const Image sheet = read_image(folder / "sheet.png");
  EXPECT_EQ(sheet.width, 12 + 4 * (5 * 48 + 12));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.png", "out.json", "sheet.png"}));
}

TEST(Noisefit, ReadsAModelFromTheStandardInput) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(48, 40));
  const RunOptions there{.folder = folder.path()};
  ASSERT_EQ(run_noisefit({"in.png", "--out", "a.json"}, there).status, 0);
  const ToolResult piped =
      RunningTool("/bin/sh", {"-c", "cat a.json | " + in_build("tools/noisefit") + " info -"}, there).wait();
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_EQ(piped.out, run_noisefit({"info", "a.json"}, there).out);
}

TEST(Noisefit, WarnsOfFallingLight) {
  const TemporaryFolder folder;
  for (const float fall : {0.0f, 0.6f}) {
    Image picture = wavy_picture(64, 64);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      const float place = static_cast<float>(i / 3 % 64) / 64.0f - 0.5f;
      picture.pixels[i] = 0.5f + 0.3f * (picture.pixels[i] - 0.5f) + fall * place;
    }
    write_image(folder / "in.png", picture, {.existing = Existing::replace});
    const ToolResult result =
        run_noisefit({"in.png", "--out", "x.json", "--force"}, {.folder = folder.path()});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("change from side to side") != std::string::npos, fall > 0.0f) << result.err;
  }
}

TEST(Noisefit, AveragesExemplarsAndKnowsGrey) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", wavy_picture(64, 40));
  write_image(folder / "b.png", wavy_picture(32, 32, 1));
  const RunOptions there{.folder = folder.path()};
  const ToolResult result =
      run_noisefit({"a.png", "b.png", "--grey", "--raw-values", "--out", "x.json"}, there);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("32 x 32 pixels, 4 patches"), std::string::npos) << result.err;
  EXPECT_EQ(model_in(folder, "x.json").channels.size(), 1u);
  EXPECT_TRUE(model_in(folder, "x.json").raw_values);
  EXPECT_EQ(run_noisefit({"a.png", "b.png", "--out", "y.json", "--quiet"}, there).err, "");
  EXPECT_EQ(model_in(folder, "y.json").channels.size(), 3u);
}

// Of a picture that is dark with bright parts, without being asked; `info` says so.
TEST(Noisefit, LearnsTheRootsOfLopsidedPictures) {
  const TemporaryFolder folder;
  Image lawn = wavy_picture(48, 40);
  for (float& value : lawn.pixels) value = std::pow(value, 3.0f);
  write_image(folder / "lawn.png", lawn);
  const RunOptions there{.folder = folder.path()};
  const ToolResult result = run_noisefit({"lawn.png", "--out", "chosen.json"}, there);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("values: squares ("), std::string::npos) << result.err;
  EXPECT_TRUE(model_in(folder, "chosen.json").squares);
  EXPECT_NE(run_noisefit({"info", "chosen.json"}, there).out.find("colours are squares"), std::string::npos);
  ASSERT_EQ(run_noisefit({"lawn.png", "--squares", "--out", "asked.json", "--quiet"}, there).status, 0);
  EXPECT_EQ(model_in(folder, "asked.json"), model_in(folder, "chosen.json"));
  ASSERT_EQ(run_noisefit({"lawn.png", "--raw-values", "--out", "raw.json", "--quiet"}, there).status, 0);
  EXPECT_FALSE(model_in(folder, "raw.json").squares);
  ASSERT_EQ(
      run_noisefit({"lawn.png", "--squares", "--solid", "--grey", "--out", "solid.json", "--quiet"}, there)
          .status,
      0);
  EXPECT_TRUE(model_in(folder, "solid.json").squares);
  EXPECT_EQ(run_noisefit({"lawn.png", "--squares", "--linear-light", "--out", "no.json"}, there).status, 2);
}

TEST(Noisefit, HasThePapersParametersAndSolidNoise) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(64, 64, 1));
  const RunOptions there{.folder = folder.path()};
  ASSERT_EQ(run_noisefit({"in.png", "--out", "ours.json"}, there).status, 0);
  ASSERT_EQ(run_noisefit({"in.png", "--out", "paper.json", "--paper"}, there).status, 0);
  const auto narrowest = [&](const std::string& name) {
    const ExemplarModel model = model_in(folder, name);
    double least = HUGE_VAL;
    for (const SpectrumBand& band : model.channels[0].bands) least = std::min(least, band.a);
    return least;
  };
  EXPECT_NEAR(narrowest("paper.json"), 0.5 * narrowest("ours.json"), 1e-9);
  const ToolResult solid = run_noisefit({"in.png", "--out", "solid.json", "--solid"}, there);
  ASSERT_EQ(solid.status, 0) << solid.err;
  EXPECT_NE(solid.err.find("attainable"), std::string::npos) << solid.err;
  EXPECT_EQ(model_in(folder, "solid.json").channels[0].dimensions, 3);
  EXPECT_TRUE(model_in(folder, "solid.json").channels[0].isotropic);
}

TEST(Noisefit, EditsGroupsAndTellsWhatIsInAFile) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(64, 64, 1));
  const RunOptions there{.folder = folder.path()};
  ASSERT_EQ(run_noisefit({"in.png", "--out", "in.json", "--quiet"}, there).status, 0);
  const ExemplarModel before = model_in(folder, "in.json");

  ASSERT_EQ(
      run_noisefit({"edit", "in.json", "--out", "b.json", "--magnitude", "2", "--rotate", "90", "--quiet"},
                   there)
          .status,
      0);
  const ExemplarModel after = model_in(folder, "b.json");
  EXPECT_NEAR(after.channels[0].variance(), 4.0 * before.channels[0].variance(), 1e-9);
  const SpectrumComponent& component = before.channels[0].bands[0].components[0];
  EXPECT_NEAR(after.channels[0].bands[0].components[0].frequency.y, component.frequency.x, 1e-12);

  ASSERT_EQ(run_noisefit(
                {"edit", "b.json", "--out", "c.json", "--group", "mine", "--add", "0.1", "0.5", "0.2", "0.3"},
                there)
                .status,
            0);
  const ToolResult info = run_noisefit({"info", "c.json"}, there);
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_NE(info.out.find("group mine: 1 components"), std::string::npos) << info.out;
  ASSERT_EQ(
      run_noisefit({"edit", "in.json", "--out", "d.json", "--copy", "c.json", "--group", "mine", "--quiet"},
                   there)
          .status,
      0);
  EXPECT_NEAR(model_in(folder, "d.json").channels[0].variance(), before.channels[0].variance() + 0.5, 1e-9);
  ASSERT_EQ(
      run_noisefit({"edit", "d.json", "--out", "e.json", "--remove", "--group", "mine", "--quiet"}, there)
          .status,
      0);
  EXPECT_NEAR(model_in(folder, "e.json").channels[0].variance(), before.channels[0].variance(), 1e-9);
}

TEST(Noisefit, KeepsTheLastSolutionWhenItIsInterrupted) {
  using namespace std::chrono_literals;
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(512, 512));
  // A gap that is never reached: all iterations of all levels, a minute or more.
  RunningTool tool(in_build("tools/noisefit"), {"in.png", "--out", "x.json", "--paper", "--gap", "1e-9"},
                   {.folder = folder.path()});
  tool.wait_until_it_catches(SIGINT);
  std::this_thread::sleep_for(1s);  // into the fit
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
  EXPECT_NE(result.err.find("x.json has the last solution"), std::string::npos) << result.err;
  EXPECT_NO_THROW(model_in(folder, "x.json").validate());
}

}  // namespace
}  // namespace solidnoise::noisefit_test
