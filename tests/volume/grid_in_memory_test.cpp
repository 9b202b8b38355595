// Grids of a program, in recipes, are as good as those of files.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_cost.h"
#include "support/message_of.h"
#include "support/parameter_grids.h"

namespace solidnoise::grid_in_memory_test {
namespace {

std::vector<std::uint64_t> made(const VolumeRecipe& recipe) {
  std::vector<std::uint64_t> sums;
  for (const MeasuredGrid& grid : make_volume(recipe, plan_volume(recipe), "tests").grids)
    sums.push_back(checksum(*grid.grid));
  return sums;
}

// Small, of a noise whose kernels may vary.
VolumeRecipe small_recipe() {
  VolumeRecipe recipe;
  recipe.noise.noise = GaborNoiseOptions{.frequency = 3.0, .impulses = 8.0, .seed = 5};
  recipe.shaping = RawShaping{};
  recipe.dim = 12;
  return recipe;
}

class GridInMemory : public testing::Test {
 protected:
  void SetUp() override { write_painted_grids(file_); }

  // What `use` makes of a recipe with a grid of the file, and with the same one from memory.
  template <typename Use>
  void expect_same(const std::string& name, const Use& use) {
    VolumeRecipe by_file = small_recipe();
    use(by_file, GridFile{file_, name});
    VolumeRecipe by_memory = small_recipe();
    use(by_memory, grid_in_memory(read_grid(file_, name)));
    EXPECT_EQ(made(by_memory), made(by_file)) << name;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("painted.vdb");
};

TEST_F(GridInMemory, IsAParameter) {
  expect_same("ramp", [](VolumeRecipe& recipe, const GridFile& grid) {
    recipe.parameters.frequency = ParameterGrid{grid, {}};
  });
  expect_same("paint", [](VolumeRecipe& recipe, const GridFile& grid) {
    recipe.parameters.magnitude = ParameterGrid{grid, ValueMap{0.0, 1.0, 0.5, 2.0}};
  });
  expect_same("turn", [](VolumeRecipe& recipe, const GridFile& grid) {
    recipe.noise.noise = OrientedGaborNoiseOptions{.frequency = 3.0, .impulses = 8.0, .anisotropy = 1.0};
    recipe.parameters.direction = grid;
  });
}

TEST_F(GridInMemory, IsAShapeAMaskAndWhatIsModified) {
  expect_same("ramp", [](VolumeRecipe& recipe, const GridFile& grid) { recipe.shape = grid; });
  expect_same("paint", [&](VolumeRecipe& recipe, const GridFile& grid) {
    recipe.modification.emplace().on = {file_, "ramp"};
    recipe.modification->mask = grid;
  });
  expect_same("ramp", [](VolumeRecipe& recipe, const GridFile& grid) {
    recipe.modification.emplace().on = grid;
    recipe.modification->combine = Combine::add;
  });
}

TEST_F(GridInMemory, StaysAsItIs) {
  const openvdb::FloatGrid::Ptr grid = read_float_grid(file_, "ramp");
  const std::uint64_t before = checksum(*grid);
  VolumeRecipe recipe = small_recipe();
  recipe.modification.emplace().on = grid_in_memory(grid);
  made(recipe);
  EXPECT_EQ(checksum(*grid), before);
}

TEST_F(GridInMemory, OfAnotherTypeIsRefused) {
  VolumeRecipe recipe = small_recipe();
  recipe.parameters.frequency = ParameterGrid{grid_in_memory(read_grid(file_, "turn")), {}};
  EXPECT_EQ(message_of<std::runtime_error>([&] { plan_volume(recipe); }),
            "(memory): is a grid of vec3s; it must be one of float");
  EXPECT_THROW(grid_in_memory(nullptr), std::invalid_argument);
}

// Octaves of frequencies are noises of their own, and high ones have many impulses.
TEST(VolumeCost, CountsWhatAMapOfFrequenciesTakes) {
  const auto grid = openvdb::FloatGrid::create();
  grid->fill(openvdb::CoordBBox(openvdb::Coord(-40), openvdb::Coord(40)), 0.5f);
  const auto seconds = [&](int dim, double lowest, double highest) {
    VolumeRecipe recipe = small_recipe();
    recipe.dim = dim;
    recipe.parameters.frequency = ParameterGrid{grid_in_memory(grid), ValueMap{0.0, 1.0, lowest, highest}};
    return volume_cost(recipe, plan_volume(recipe), 1).seconds;
  };
  EXPECT_GT(seconds(160, 4.0, 8.0), 1.5 * seconds(160, 8.0, 8.01));
  EXPECT_GT(seconds(64, 10.0, 40.0), 5.0 * seconds(64, 8.0, 8.01));
}

// Kernels of narrow bands are polynomials of high degrees: of 6 and 92, of as many impulses.
TEST(VolumeCost, CountsThePolynomialsOfNarrowBands) {
  const auto seconds = [&](double bandwidth) {
    VolumeRecipe recipe = small_recipe();
    recipe.dim = 160;
    recipe.exact = true;
    recipe.noise.noise = GaborNoiseOptions{.frequency = 8.0, .bandwidth = bandwidth, .impulses = 100.0};
    return volume_cost(recipe, plan_volume(recipe), 1).seconds;
  };
  EXPECT_GT(seconds(0.05), 3.0 * seconds(1.0));
}

}  // namespace
}  // namespace solidnoise::grid_in_memory_test
