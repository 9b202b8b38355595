#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "noisefit/expect_fit_memory.h"
#include "noisefit/run_noisefit.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "support/temporary_folder.h"
#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::volume_test {
namespace {

// A block of Gabor noise of a known frequency, as vdbnoise makes it, and the noise that is learnt from it.
class NoisefitVolume : public testing::Test {
 protected:
  void SetUp() override {
    const ToolResult made = run_vdbnoise({"--preset", "raw", "--out", "in.vdb", "--dim", "32", "--frequency",
                                          "6", "--octaves", "1", "--quiet"},
                                         there_);
    ASSERT_EQ(made.status, 0) << made.err;
  }

  TemporaryFolder folder_;
  RunOptions there_{.folder = folder_.path()};
};

TEST_F(NoisefitVolume, FindsTheFrequencyOfItsNoise) {
  const ToolResult result = run_noisefit({"volume", "in.vdb", "--out", "x.json"}, there_);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("32 x 32 x 32 voxels"), std::string::npos) << result.err;
  const ExemplarModel model = exemplar_file_from_json(parse_json(folder_.read("x.json")));
  ASSERT_EQ(model.channels.size(), 1u);
  // The model's own, to three digits, in voxels of 1/16; 6 cycles per unit to a few hundredths in so small a
  // block.
  double pixels = 0.0;
  double units = 0.0;
  const std::size_t told = result.err.find("principal wavelength: ");
  ASSERT_NE(told, std::string::npos) << result.err;
  ASSERT_EQ(
      std::sscanf(result.err.c_str() + told, "principal wavelength: %lf pixels, %lf units", &pixels, &units),
      2)
      << result.err;
  const GaborSpectrum& spectrum = model.channels[0];
  EXPECT_NEAR(pixels, 16.0 / model.principal_frequency(), 0.005);
  EXPECT_NEAR(units, 1.0 / model.principal_frequency(), 0.0005);
  EXPECT_NEAR(model.principal_frequency(), 6.0, 0.3);
  EXPECT_EQ(spectrum.dimensions, 3);
  EXPECT_FALSE(spectrum.isotropic);
  EXPECT_TRUE(model.raw_values);
  // The noise's band is an octave wide about 6 cycles per unit; its mean lies within a fifth of that.
  double mean = 0.0;
  for (const SpectrumBand& band : spectrum.bands) {
    for (const SpectrumComponent& c : band.components) {
      mean += glm::length(c.frequency) * c.variance / spectrum.variance();
    }
  }
  EXPECT_NEAR(mean, 6.0, 1.2);
  // The variance is 1, of which a block of 6 waves along each axis shows a tenth more or less.
  EXPECT_NEAR(spectrum.variance(), 1.0, 0.3);
}

TEST_F(NoisefitVolume, DrawsSlicesOfBoth) {
  const ToolResult result =
      run_noisefit({"volume", "in.vdb", "--out", "x.json", "--preview", "sheet.exr", "--quiet"}, there_);
  ASSERT_EQ(result.status, 0) << result.err;
  const Image sheet = read_image(folder_.path() / "sheet.exr");
  // Four panels of 32 pixels, each enlarged 7 times, and margins of 12. Volume and noise have values of both
  // signs, which are dark and bright about a middle grey: the mean over a panel, inset apart, is neither.
  ASSERT_EQ(sheet.width, 12 + 4 * (32 * 7 + 12));
  for (int panel = 0; panel < 4; ++panel) {
    double mean = 0.0;
    for (int x = 0; x < 100; ++x) {
      for (int y = 0; y < 100; ++y) mean += sheet.at(12 + panel * (32 * 7 + 12) + x, 38 + y, 0) / 1e4;
    }
    EXPECT_GT(mean, 0.2) << panel;
    EXPECT_LT(mean, 0.8) << panel;
  }
}

// 16 voxels to a unit.
TEST_F(NoisefitVolume, TakesABox) {
  const ToolResult result = run_noisefit(
      {"volume", "in.vdb", "--box", "-0.5", "-0.5", "-0.5", "0.5", "0.5", "0.5", "--out", "x.json"}, there_);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("16 x 16 x 16 voxels"), std::string::npos) << result.err;
}

TEST_F(NoisefitVolume, TakesTheMemoryThatItSays) {
  const ToolResult made = run_vdbnoise(
      {"--preset", "raw", "--out", "large.vdb", "--dim", "96", "--frequency", "6", "--quiet"}, there_);
  ASSERT_EQ(made.status, 0) << made.err;
  const std::vector<std::string> whole{"volume", "large.vdb", "--box", "-1", "-1", "-1", "1", "1", "1"};
  std::vector<std::string> in_patches = whole;
  in_patches.insert(in_patches.end(), {"--patch", "32"});
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"volume", "in.vdb"},
                                             {"volume", "in.vdb", "--preview", "x.png"},
                                             {"volume", "large.vdb"},
                                             whole,
                                             in_patches}) {
    expect_fit_memory(command, there_);
  }
}

TEST_F(NoisefitVolume, RefusesWhatItCannotLearnFrom) {
  const std::vector<Refusal> refusals = {
      {"Missing", 1, {"volume", "none.vdb", "--out", "x.json"}, {"none.vdb"}},
      {"NoGrid", 1, {"volume", "in.vdb", "--grid", "no", "--out", "x.json"}, {"no"}},
      {"SmallBox",
       1,
       {"volume", "in.vdb", "--box", "0", "0", "0", "0.1", "1", "1", "--out", "x.json"},
       {"in.vdb", "at least 16"}},
      {"FarBox",
       1,
       {"volume", "in.vdb", "--box", "5", "5", "5", "6", "6", "6", "--out", "x.json"},
       {"in.vdb", "is constant"}},
      {"LargeBox",
       2,
       {"volume", "in.vdb", "--box", "-9", "-9", "-9", "9", "9", "9", "--out", "x.json"},
       {"--box", "256 at most"}},
      {"Kappa", 2, {"volume", "in.vdb", "--kappa", "3", "--out", "x.json"}, {"--kappa is 3"}},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.name);
    expect_refusal(run_noisefit(refusal.arguments, there_), refusal, "noisefit volume");
  }
}

}  // namespace
}  // namespace solidnoise::volume_test
