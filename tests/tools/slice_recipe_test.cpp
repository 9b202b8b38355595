// vdbnoise slice of what recipes fill volumes with.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/run_slice.h"

namespace solidnoise::slice_recipe_test {
namespace {

struct Sliced {
  std::string name;
  std::string recipe;  // JSON
  std::string grid;
  std::string component{};  // of vectors
  bool soft = false;        // voxels at its edge have the share of what is in them; pixels have it or not
};

void PrintTo(const Sliced& sliced, std::ostream* out) {
  *out << sliced.name;
}

class SliceOfAnyRecipe : public testing::TestWithParam<Sliced> {};

// Densities are those of the volume over its factor, but for those that are left out (--prune). Voxels of
// 1/16, pixels of which the middles are voxels' centres: clouds, whose edges depend on the size, are the
// same.
TEST_P(SliceOfAnyRecipe, IsWhatTheVolumeHas) {
  const TemporaryFolder folder;
  folder.write("recipe.json", GetParam().recipe);
  const std::string recipe = folder.file("recipe.json");
  ASSERT_EQ(run_vdbnoise({"--recipe", recipe, "--voxel", "0.0625", "--exact", "--quiet", "--out",
                          folder.file("x.vdb")})
                .status,
            0);
  std::vector<std::string> plane{"--grid", GetParam().grid, "--origin", "-0.03125",     "-0.03125",
                                 "0.125",  "--width",       "1.875",    "--resolution", "30"};
  if (!GetParam().component.empty()) plane.insert(plane.end(), {"--component", GetParam().component});
  std::vector<std::string> of_file = plane;
  of_file.insert(of_file.begin(), folder.file("x.vdb"));
  plane.insert(plane.end(), {"--recipe", recipe});
  const Image field = slice(plane);
  const Image volume = slice(of_file);
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < field.pixels.size(); ++i) {
    products += static_cast<double>(field.pixels[i]) * volume.pixels[i];
    squares += static_cast<double>(field.pixels[i]) * field.pixels[i];
  }
  ASSERT_GT(squares, 0.0);
  const bool scaled = GetParam().recipe.find("raw") == std::string::npos;
  const double factor = scaled ? products / squares : 1.0;
  const double largest = *std::ranges::max_element(volume.pixels);
  double differences = 0.0;
  for (std::size_t i = 0; i < field.pixels.size(); ++i) {
    const double difference = std::abs(factor * field.pixels[i] - volume.pixels[i]);
    differences += difference;
    ASSERT_LT(difference, (GetParam().soft ? 1.0 : 3e-3) * largest) << i;
  }
  EXPECT_LT(differences / static_cast<double>(field.pixels.size()), 0.03 * largest);
}

const Sliced kSliced[] = {
    {"Cloud",
     R"({"solidnoise": 2, "noise": {"type": "gabor", "frequency": 1}, "shaping": {"type": "cloud"}})",
     "density", "", true},
    {"Veins",
     R"({"solidnoise": 2, "noise": {"type": "gabor", "frequency": 2}, "shaping": {"type": "veins"}})",
     "density"},
    {"SoftSphere",
     R"({"solidnoise": 2, "noise": {"type": "gabor", "frequency": 2}, "shaping": {"type": "remap"},
         "domain": {"shape": {"type": "sphere"}, "edge": 0.4}})",
     "density"},
    {"HardEllipsoid",
     R"({"solidnoise": 2, "noise": {"type": "gabor"}, "shaping": {"type": "raw"},
         "domain": {"shape": {"type": "ellipsoid"}, "box": [-1, -0.6, -1, 1, 0.6, 1]}})",
     "density"},
    {"Velocity",
     R"({"solidnoise": 2, "noise": {"type": "gabor"}, "shaping": {"type": "raw"}, "output": "curl"})", "vel",
     "y"},
    {"Intensity",
     R"({"solidnoise": 2, "noise": {"type": "gabor-oriented"}, "shaping": {"type": "raw"}, "output": "phase,intensity"})",
     "intensity"},
    {"NamedFields",
     R"({"solidnoise": 2, "noise": {"type": "gabor"}, "fields": {"coarse": {"fold": "ridged"}},
         "grids": [{"name": "one", "shaping": {"type": "raw"}, "layers": [{"use": "coarse"}]},
                   {"name": "two", "shaping": {"type": "raw"}, "noise": {"type": "gabor", "seed": 4},
                    "layers": [{"use": "coarse", "weight": 0.5}, {"noise": {"type": "gabor", "frequency": 3}, "weight": 0.5}]}]})",
     "two"},
};
INSTANTIATE_TEST_SUITE_P(All, SliceOfAnyRecipe, testing::ValuesIn(kSliced),
                         [](const auto& test) { return test.param.name; });

TEST(SliceOfRecipe, OfADensityShowsItsWholeBox) {
  const TemporaryFolder folder;
  folder.write("flat.json",
               R"({"solidnoise": 2, "noise": {"type": "gabor"}, "shaping": {"type": "remap", "threshold": -9},
                   "domain": {"box": [0, 0, 0, 4, 2, 1]}})");
  const Image image = slice({"--recipe", folder.file("flat.json"), "--resolution", "40"});
  for (int column = 0; column < 40; ++column) {
    for (int row = 0; row < 40; ++row) {
      ASSERT_EQ(image.at(column, row), row < 10 || row >= 30 ? 0.0f : 1.0f) << column << ' ' << row;
    }
  }
}

TEST(SliceOfRecipe, OfABoxAlongALineIsAsLongAsTheBox) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_slice({"--preset", "fire", "--resolution", "60", "--out", folder.file("x.csv")}).status, 0);
  std::istringstream table(folder.read("x.csv"));
  std::string line;
  std::getline(table, line);
  int positive = 0;
  for (int row = 0; std::getline(table, line); ++row) {
    EXPECT_NEAR(std::stod(line), -0.6 + 0.02 * (row + 0.5), 1e-9);
    positive += std::stod(line.substr(line.find(',') + 1)) > 0.0 ? 1 : 0;
  }
  EXPECT_GT(positive, 10);
}

// Grids that belong to a density end where it does.
TEST(SliceOfRecipe, OfAnyGridOfARecipeWithDensitiesEndsAtItsBox) {
  for (const char* const grid : {"density", "temperature", "flame"}) {
    const Image below = slice({"--preset", "fire", "--grid", grid, "--origin", "0", "-0.3", "0", "--width",
                               "0.2", "--resolution", "16"});
    EXPECT_EQ(*std::ranges::max_element(below.pixels), 0.0f) << grid;
  }
}

TEST(SliceOfRecipe, OfABandLimitedDensityFiltersItsNoise) {
  const std::vector<std::string> flags{"--preset", "smoke", "--resolution", "48"};
  std::vector<std::string> limited = flags;
  limited.push_back("--band-limit");
  EXPECT_NE(slice(flags).pixels, slice(limited).pixels);
}

}  // namespace
}  // namespace solidnoise::slice_recipe_test
