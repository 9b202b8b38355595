#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::normalize_test {
namespace {

const std::vector<std::vector<std::string>> kNoises{
    {"--noise", "gabor"},   {"--noise", "gabor-oriented", "--anisotropy", "0.6"},
    {"--noise", "kensler"}, {"--noise", "cellular"},
    {"--octaves", "3"},
};

struct Spread {
  double mean = 0.0;
  double variance = 0.0;
};

// How far the moments of volumes of four seeds are from 0 and 1 at most.
Spread farthest(std::vector<std::string> command) {
  const TemporaryFolder folder;
  command.insert(command.end(), {"--raw", "--quiet", "--force", "--out", folder.file("x.vdb"), "--seed", ""});
  Spread farthest;
  for (const char* const seed : {"1", "2", "3", "4"}) {
    command.back() = seed;
    const ToolResult result = run_vdbnoise(command);
    EXPECT_EQ(result.status, 0) << result.err;
    const Moments moments = measure(*read_float_grid(folder.file("x.vdb")));
    farthest.mean = std::max(farthest.mean, std::abs(moments.mean()));
    farthest.variance = std::max(farthest.variance, std::abs(moments.sigma() * moments.sigma() - 1.0));
  }
  return farthest;
}

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Few waves fit into these boxes, which makes each seed's moments its own.
TEST(Normalize, GivesATileTheMomentsOfTheNoise) {
  const std::vector<std::string> tile{"--frequency", "2", "--period", "2", "2", "2", "--voxel", "0.05"};
  for (const auto& noise : kNoises) {
    SCOPED_TRACE(testing::PrintToString(noise));
    const Spread as_it_is = farthest(joined(tile, noise));
    EXPECT_GT(std::max(as_it_is.mean, as_it_is.variance), 0.03);
    const Spread normalized = farthest(joined(tile, joined(noise, {"--normalize"})));
    EXPECT_LT(normalized.mean, 2e-3);
    EXPECT_LT(normalized.variance, 5e-3);
  }
}

TEST(Normalize, GivesABoxTheMomentsOfTheNoise) {
  const std::vector<std::string> box{"--frequency", "2", "--dim", "48"};
  for (const auto& noise : kNoises) {
    SCOPED_TRACE(testing::PrintToString(noise));
    const Spread normalized = farthest(joined(box, joined(noise, {"--normalize"})));
    EXPECT_LT(normalized.mean, 0.02);
    EXPECT_LT(normalized.variance, 0.02);
  }
  const Spread in_range = farthest({"--frequency", "2", "--dim", "48", "--range", "unit", "--normalize"});
  EXPECT_NEAR(in_range.mean, 0.5, 0.01);
}

// The number behind a word.
double number_after(const std::string& text, const std::string& word) {
  const std::string::size_type at = text.find(word + " ");
  return at == std::string::npos ? NAN : std::stod(text.substr(at + word.size() + 1));
}

TEST(Normalize, GivesATextureTheMomentsOfTheNoise) {
  const TemporaryFolder folder;
  const std::vector<std::string> texture{"--period", "2", "2", "0", "--frequency", "2", "--dims", "2"};
  const std::vector<std::vector<std::string>> cases{
      joined(texture, {"--out", "x.png"}),
      joined(texture, {"--out", "x.png", "--exact"}),
      joined(texture, {"--out", "x.png", "--noise", "kensler"}),
      {"--dims", "1", "--period", "2", "0", "0", "--frequency", "2", "--out", "x.csv"},
  };
  for (const auto& flags : cases) {
    SCOPED_TRACE(testing::PrintToString(flags));
    const ToolResult result =
        run_vdbnoise(joined({"slice", "--force", "--normalize"}, flags), {.folder = folder.path()});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NEAR(number_after(result.err, "mean"), 0.0, 2e-3);
    EXPECT_NEAR(number_after(result.err, "sigma"), 1.0, 2e-3);
  }
}

TEST(Normalize, IsRefusedWhereItWouldFlickerOrMeanNothing) {
  const std::vector<std::vector<std::string>> refused{
      {"--dims", "4"},      {"--evolve", "0.5"},      {"--wind", "1", "0", "0"},
      {"--fold", "ridged"}, {"--output", "gradient"},
  };
  const TemporaryFolder folder;
  for (const auto& flags : refused) {
    const ToolResult result =
        run_vdbnoise(joined({"--raw", "--normalize", "--out", "x.vdb"}, flags), {.folder = folder.path()});
    EXPECT_EQ(result.status, 2) << flags.front() << result.err;
    EXPECT_NE(result.err.find("--normalize is true; it applies to"), std::string::npos) << result.err;
  }
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace solidnoise::normalize_test
