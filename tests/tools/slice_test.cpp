#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "support/paths.h"
#include "tools/refusal.h"
#include "tools/run_slice.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::slice_test {
namespace {

double variance(const Image& image) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += static_cast<double>(value) * value;
  return sum / static_cast<double>(image.pixels.size());
}

// The mean over 30 x 30 wavelengths of noises of excess kurtosis up to 0.5: some 400 independent values,
// whose variance has a relative standard error of sqrt(2.5 / 400) = 0.08; four of them are allowed.
TEST(Slice, OfANoiseOfEachDimensionHasUnitVariance) {
  const std::vector<std::vector<std::string>> kinds{{"2"}, {"3"}, {"4", "--time", "0.3"}};
  for (const std::vector<std::string>& dims : kinds) {
    std::vector<std::string> flags{"--frequency", "15", "--resolution", "180", "--dims"};
    flags.insert(flags.end(), dims.begin(), dims.end());
    EXPECT_NEAR(variance(slice(flags)), 1.0, 0.32) << dims[0];
  }
}

// A voxel's value and that of the pixel at its centre are the same sums, of positions rounded to single
// precision here and exact there.
TEST(Slice, IsWhatTheVolumeOfTheRecipeHasInThatPlane) {
  const TemporaryFolder folder;
  const std::vector<std::string> noise{"--frequency", "3", "--seed", "5", "--octaves", "2"};
  std::vector<std::string> make{"--raw", "--quiet", "--voxel", "0.125", "--out", folder.file("x.vdb")};
  make.insert(make.end(), noise.begin(), noise.end());
  ASSERT_EQ(run_vdbnoise(make).status, 0);
  const openvdb::FloatGrid::Ptr grid = read_float_grid(folder.file("x.vdb"));
  const auto voxels = grid->getConstAccessor();

  // The plane of voxels through the middle, seen from three sides.
  const std::vector<std::string> square{"--width", "2", "--resolution", "16"};
  struct Side {
    std::vector<std::string> flags;
    openvdb::Coord right, up, first;
  };
  const std::vector<Side> sides{
      {{"--origin", "-0.0625", "-0.0625", "0"}, {1, 0, 0}, {0, 1, 0}, {-8, -8, 0}},
      {{"--origin", "0", "-0.0625", "-0.0625", "--normal", "1", "0", "0"}, {0, 0, -1}, {0, 1, 0}, {0, -8, 7}},
      {{"--origin", "-0.0625", "0", "-0.0625", "--axes", "0", "0", "1", "1", "0", "0"},
       {0, 0, 1},
       {1, 0, 0},
       {-8, 0, -8}},
  };
  for (const Side& side : sides) {
    std::vector<std::string> flags = square;
    flags.insert(flags.end(), side.flags.begin(), side.flags.end());
    std::vector<std::string> of_grid = flags;
    of_grid.insert(of_grid.begin(), folder.file("x.vdb"));
    flags.insert(flags.end(), noise.begin(), noise.end());
    const Image of_noise = slice(flags);
    const Image interpolated = slice(of_grid);
    ASSERT_EQ(of_noise.width, 16);
    ASSERT_EQ(of_noise.height, 16);
    for (int column = 0; column < 16; ++column) {
      for (int row = 0; row < 16; ++row) {
        openvdb::Coord voxel = side.first;
        for (int axis = 0; axis < 3; ++axis) voxel[axis] += column * side.right[axis] + row * side.up[axis];
        const float expected = voxels.getValue(voxel);
        ASSERT_NEAR(of_noise.at(column, 15 - row), expected, 2e-4) << voxel;
        ASSERT_NEAR(interpolated.at(column, 15 - row), expected, 1e-5) << voxel;
      }
    }
  }
}

// Positions are multiples of 2^-5, which single precision holds.
TEST(Slice, WithAPeriodIsOneTileWhichRepeats) {
  for (const std::string dims : {"2", "3"}) {
    const std::vector<std::string> noise{"--dims", dims, "--frequency", "3", "--period", "2", "2", "0"};
    std::vector<std::string> flags = noise;
    flags.insert(flags.end(), {"--resolution", "64"});
    const Image tile = slice(flags);
    flags = noise;
    flags.insert(flags.end(), {"--resolution", "128", "--width", "4", "--origin", "1", "1", "0"});
    const Image four = slice(flags);
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x)
        ASSERT_EQ(four.at(x, y), tile.at(x % 64, y % 64)) << dims << " " << x << " " << y;
    }
  }
}

TEST(Slice, IsTheSameFromAnyNumberOfThreads) {
  const std::vector<std::string> flags{"--normal", "1", "2", "3", "--resolution", "100", "70", "--threads"};
  std::vector<std::string> one = flags;
  std::vector<std::string> four = flags;
  one.push_back("1");
  four.push_back("4");
  EXPECT_EQ(slice(one).pixels, slice(four).pixels);
}

TEST(Slice, OfALineIsATable) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_slice({"--dims", "1", "--frequency", "4", "--width", "8", "--resolution", "64", "--out",
                       "line.csv"},
                      {.folder = folder.path()})
                .status,
            0);
  std::istringstream lines(folder.read("line.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "position,value");
  for (int i = 0; i < 64; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_DOUBLE_EQ(std::stod(line), (i + 0.5) / 8.0 - 4.0);
    EXPECT_NE(line.find(','), std::string::npos);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(Slice, MapsValuesToPixelsAsAsked) {
  const TemporaryFolder folder;
  const std::vector<std::string> noise{"--frequency", "4", "--resolution", "24"};
  const Image values = slice(noise);
  const auto picture = [&](const std::string& name, std::vector<std::string> flags) {
    flags.insert(flags.end(), noise.begin(), noise.end());
    flags.insert(flags.end(), {"--out", folder.file(name)});
    const ToolResult result = run_slice(flags);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_image(folder.file(name));
  };
  const Image grey = picture("grey.png", {"--bits", "16", "--values", "-2", "2"});
  const Image colors = picture("colors.png", {"--ramp", "0:#f00,0.01:#0f0"});
  ASSERT_EQ(grey.channels, 1);
  ASSERT_EQ(colors.channels, 3);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      const float value = values.at(x, y);
      EXPECT_NEAR(grey.at(x, y), std::clamp(0.25f * value + 0.5f, 0.0f, 1.0f), 1.0f / 65535.0f);
      // The ramp's positions are fractions of the way from -3 to 3 sigmas: it is green from -2.94 on.
      EXPECT_EQ(colors.at(x, y, 1) == 1.0f, value > -2.94f) << value;
    }
  }
}

// The ring of an isotropic noise is at its frequency: the mean of |f|, weighted by the density, is F0 within
// the width of the band.
TEST(Slice, HasItsSpectrumWhereTheFrequencyIs) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_slice({"--dims", "2", "--frequency", "8", "--period", "4", "4", "0", "--resolution", "128",
                       "--spectrum", folder.file("s.exr")})
                .status,
            0);
  const Image spectrum = read_image(folder.file("s.exr"));
  ASSERT_EQ(spectrum.width, 128);
  double sum = 0.0;
  double weighted = 0.0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const double frequency = std::hypot(x - 64, 63 - y) / 4.0;  // in steps of one over the period
      const double density = spectrum.at(x, y);
      // A real field's densities at f and -f are the same.
      if (x > 0 && y < 127) {
        ASSERT_NEAR(density, spectrum.at(128 - x, 126 - y), 1e-5 * (1.0 + density)) << x << " " << y;
      }
      sum += density;
      weighted += density * frequency;
    }
  }
  EXPECT_NEAR(weighted / sum, 8.0, 1.0);
  EXPECT_NEAR(sum / 16.0, 1.0, 0.3);  // the variance
}

// A model of one pair of waves per channel, whose colours are (1, 0, 0), (0, 1, 0) and (0, 0, 1) about a
// mean.
constexpr char kColors[] = R"({"solidnoise": 1, "exemplar": {"raw_values": true, "mean": [0.2, 0.5, 0.7],
  "channels": [{"axis": [1, 0, 0], "bands": [{"a": 0.05, "components": [[0.1, 0.0, 0.01, 0]]}]},
               {"axis": [0, 1, 0], "bands": [{"a": 0.05, "components": [[0.0, 0.1, 0.04, 0]]}]},
               {"axis": [0, 0, 1], "bands": [{"a": 0.05, "components": [[0.07, 0.07, 0.01, 0]]}]}]}})";

// Of some 30 x 30 wavelengths in each channel, the mean is off by less than a tenth of a deviation, and the
// deviation by less than a tenth.
TEST(Slice, InColorHasTheColorsOfTheExemplar) {
  const TemporaryFolder folder;
  folder.write("colors.json", kColors);
  const Image colors = slice({"--noise", folder.file("colors.json"), "--color", "--dims", "2", "--frequency",
                              "16", "--period", "2", "2", "0", "--resolution", "128"});
  ASSERT_EQ(colors.channels, 3);
  const double mean[] = {0.2, 0.5, 0.7};
  const double deviation[] = {0.1, 0.2, 0.1};
  for (int channel = 0; channel < 3; ++channel) {
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        const double offset = colors.at(x, y, channel) - mean[channel];
        sum += offset / (128.0 * 128.0);
        sum_of_squares += offset * offset / (128.0 * 128.0);
      }
    }
    EXPECT_NEAR(sum, 0.0, 0.1 * deviation[channel]);
    EXPECT_NEAR(std::sqrt(sum_of_squares), deviation[channel], 0.15 * deviation[channel]);
  }
}

TEST(Slice, InColorIsOfThreeIndependentNoises) {
  const Image colors = slice({"--color", "--dims", "2", "--frequency", "15", "--resolution", "180"});
  ASSERT_EQ(colors.channels, 3);
  double products = 0.0;
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 180; ++x) products += colors.at(x, y, 0) * colors.at(x, y, 1) / (180.0 * 180.0);
  }
  EXPECT_NEAR(products, 0.0, 0.2);  // 400 independent values: four standard errors
}

TEST(Slice, BesideAShapeSaysSo) {
  const TemporaryFolder folder;
  const auto warned = [&](const std::string& x) {
    const ToolResult result = run_vdbnoise({"slice", "--preset", "cumulus", "--resolution", "24", "--origin",
                                            x, "0.5", "0", "--force", "--out", "x.png"},
                                           {.folder = folder.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err.find("warning: all pixels are 0") != std::string::npos;
  };
  EXPECT_TRUE(warned("50"));
  EXPECT_FALSE(warned("0"));
}

class SliceRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(SliceRefusal, IsOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("exists.png", "precious");
  folder.write("garbage.vdb", "this is no volume");
  const std::set<std::string> before = folder.names();
  std::vector<std::string> arguments{"slice"};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  expect_refusal(run_vdbnoise(arguments, {.folder = folder.path()}), GetParam(), "vdbnoise slice");
  EXPECT_EQ(folder.names(), before);
  EXPECT_EQ(folder.read("exists.png"), "precious");
}

const Refusal kRefusals[] = {
    {"NoOutput", 2, {}, {"--out"}},
    {"FarPixels",
     1,
     {"--out", "x.png", "--frequency", "400", "--dims", "4", "--max-time", "1"},
     {"--max-time"}},
    {"WrongExtension", 2, {"--out", "x.gif"}, {"--out is x.gif", ".png"}},
    {"WrongSpectrum", 2, {"--spectrum", "x.csv"}, {"--spectrum is x.csv"}},
    {"Exists", 1, {"--out", "exists.png"}, {"exists.png", "--force"}},
    {"SameName", 2, {"--out", "x.png", "--spectrum", "x.png"}, {"x.png"}},
    {"Dims", 2, {"--dims", "5", "--out", "x.png"}, {"--dims is 5", "1 and 4"}},
    {"PictureOfALine", 2, {"--dims", "1", "--out", "x.png"}, {"--dims is 1", ".csv"}},
    {"SpectrumOfALine", 2, {"--out", "x.csv", "--spectrum", "x.png"}, {"--spectrum", "line"}},
    {"NoNormal", 2, {"--normal", "0", "0", "0", "--out", "x.png"}, {"--normal is 0 0 0"}},
    {"UpAlongNormal",
     2,
     {"--normal", "0", "0", "2", "--up", "0", "0", "1", "--out", "x.png"},
     {"--up is 0 0 1"}},
    {"AxesAndNormal",
     2,
     {"--axes", "1", "0", "0", "0", "1", "0", "--normal", "0", "0", "1", "--out", "x.png"},
     {"--axes"}},
    {"Width", 2, {"--width", "0", "--out", "x.png"}, {"--width is 0"}},
    {"ShapedPixels",
     2,
     {"--preset", "cumulus", "--width", "1e-9", "--out", "x.png"},
     {"the side of a pixel is 1.953125e-12"}},
    {"Resolution", 2, {"--resolution", "0", "--out", "x.png"}, {"--resolution is 0"}},
    {"HalfAPixel", 2, {"--resolution", "10.5", "--out", "x.png"}, {"--resolution is 10.5"}},
    {"Values", 2, {"--values", "1", "1", "--out", "x.png"}, {"--values is 1 1"}},
    {"Ramp", 2, {"--ramp", "rainbow", "--out", "x.png"}, {"rainbow", "viridis"}},
    {"Bits", 2, {"--bits", "16", "--out", "x.exr"}, {"--bits"}},
    {"ColorAndRamp", 2, {"--color", "--ramp", "rust", "--out", "x.png"}, {"--color", "--ramp"}},
    {"ColorOfALine", 2, {"--color", "--out", "x.csv"}, {"--color", "line"}},
    {"NoSuchGrid",
     2,
     {"--preset", "fire", "--grid", "heat", "--out", "x.png"},
     {"--grid is heat", "density, temperature, flame, vel"}},
    {"ComponentOfValues", 2, {"--component", "x", "--out", "x.png"}, {"--component", "vectors"}},
    {"RampOfVectors",
     2,
     {"--preset", "velocity", "--ramp", "rust", "--out", "x.png"},
     {"--ramp", "--component"}},
    {"ColorOfShaped", 2, {"--preset", "cumulus", "--color", "--out", "x.png"}, {"--color"}},
    {"FlatAndShaped", 2, {"--preset", "cumulus", "--dims", "2", "--out", "x.png"}, {"--dims is 2"}},
    {"SpectrumScale",
     2,
     {"--spectrum-scale", "linear", "--out", "x.png"},
     {"--spectrum-scale", "--spectrum"}},
    {"RawOfSeveral", 2, {"--preset", "fire", "--raw", "--out", "x.png"}, {"--raw"}},
    {"NoiseOfAFile", 2, {"garbage.vdb", "--seed", "2", "--out", "x.png"}, {"--seed"}},
    {"GridOfNoName", 2, {"--grid", "heat", "--out", "x.png"}, {"--grid is heat", "density"}},
    {"Garbage", 1, {"garbage.vdb", "--out", "x.png"}, {"garbage.vdb"}},
    {"Missing", 1, {"missing.vdb", "--out", "x.png"}, {"missing.vdb"}},
    {"BandLimit", 2, {"--noise", "kensler", "--band-limit", "--out", "x.png"}, {"--band-limit", "kensler"}},
};
INSTANTIATE_TEST_SUITE_P(All, SliceRefusal, testing::ValuesIn(kRefusals),
                         [](const auto& test) { return test.param.name; });

TEST(Slice, InterruptedLeavesNothing) {
  const TemporaryFolder folder;
  RunningTool tool(in_build("tools/vdbnoise"),
                   {"slice", "--dims", "4", "--resolution", "5000", "--width", "4", "--out", "x.png"},
                   {.folder = folder.path()});
  tool.wait_until_it_catches(SIGINT);
  tool.send(SIGINT);
  const ToolResult result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGINT) << result.err;
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace solidnoise::slice_test
