#include "solidnoise/volume/sky/sky_plan.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/sky/sky_grid.h"
#include "solidnoise/volume/sky/sky_scene.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::sky_plan_test {
namespace {

// The cloud of the tool's sky, of fewer octaves.
SkyRecipe sky() {
  SkyRecipe recipe;
  recipe.cloud.noise.noise =
      OrientedGaborNoiseOptions{.frequency = 2.8, .error = 0.05, .impulses = 20, .seed = 7};
  recipe.cloud.noise.fractal = {.octaves = 4, .lacunarity = 2.1, .gain = 0.48};
  recipe.cloud.shaping = CloudShaping{.edge = 0.09, .wisps = 1.0};
  recipe.cloud.box = {{-1.0, 0.0, -0.8}, {1.0, 1.0, 0.8}};
  recipe.points =
      ScatteredPoints{.count = 60, .area = {-3000, -3000, 3000, 3000}, .smallest = 300, .largest = 900};
  recipe.kinds = 5;
  recipe.voxel = 10.0;
  return recipe;
}

SkyRecipe of_points(const TemporaryFolder& folder, const std::string& rows) {
  folder.write("points.csv", "x,y,z,size,turn,seed\n" + rows);
  SkyRecipe recipe = sky();
  recipe.points = PointsFile{.file = folder.file("points.csv")};
  return recipe;
}

const openvdb::FloatGrid& float_grid(const Volume& volume) {
  return dynamic_cast<const openvdb::FloatGrid&>(*volume.grids.front().grid);
}

// The integral of the density over the world.
double mass(const openvdb::FloatGrid& grid) {
  const Moments moments = measure(grid);
  return moments.mean() * static_cast<double>(moments.count()) * std::pow(grid.voxelSize().x(), 3);
}

TEST(SkyPlan, PlacesEveryPointOnceByItsOwnCloud) {
  SkyRecipe recipe = sky();
  recipe.lod_from = Vec<3>(0.0, 100.0, 4000.0);
  recipe.lod_angle = 0.3;
  const SkyPlan plan = plan_sky(recipe, SkyForm::instances);
  ASSERT_EQ(plan.instances.size(), 60u);
  std::set<std::string> names;
  std::vector<int> uses(plan.clouds.size());
  for (const SkyCloud& cloud : plan.clouds) {
    names.insert(cloud.name);
    EXPECT_NEAR(*cloud.recipe.voxel * cloud.unit, 10.0 * std::exp2(cloud.level), 1e-9);
    EXPECT_FALSE(cloud.recipe.band_limit);
  }
  EXPECT_EQ(names.size(), plan.clouds.size());
  for (const SkyInstance& instance : plan.instances) {
    const SkyCloud& cloud = plan.clouds[instance.cloud];
    ++uses[instance.cloud];
    EXPECT_EQ(instance.point.seed, seed_of(cloud.recipe.noise));
    EXPECT_NEAR(instance.scale * cloud.size, instance.point.size, 1e-9 * cloud.size);
    EXPECT_LE(std::abs(std::log(instance.scale)), 0.5 * std::log(kSizeRatio) + 1e-9);
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 0), 0);
  const std::set<std::uint64_t> seeds = [&] {
    std::set<std::uint64_t> all;
    for (const SkyInstance& instance : plan.instances) all.insert(*instance.point.seed);
    return all;
  }();
  EXPECT_EQ(seeds, (std::set<std::uint64_t>{7, 8, 9, 10, 11}));
}

TEST(SkyPlan, GivesFarCloudsLargerVoxels) {
  const TemporaryFolder folder;
  SkyRecipe recipe = of_points(folder, "0,0,0,800,0,1\n0,0,-3000,800,0,1\n0,0,-90000,800,0,1\n");
  recipe.voxel = 5.0;
  recipe.lod_from = Vec<3>(0.0, 0.0, 0.0);
  recipe.lod_angle = 0.3;
  const SkyPlan plan = plan_sky(recipe, SkyForm::instances);
  const auto level = [&](std::size_t i) { return plan.clouds[plan.instances[i].cloud].level; };
  EXPECT_EQ(level(0), 0);
  // The ball around the cloud is 550 in radius and 200 up: from 2457 away 0.3 degrees are 12.9.
  EXPECT_EQ(level(1), 1);
  EXPECT_EQ(level(2), 2);  // 32 voxels of 25 along the box at least
}

TEST(SkyPlan, DoesNotDependOnTheOrderOfPointsOfAFile) {
  const TemporaryFolder folder;
  const std::string a = "0,0,0,800,10,1\n";
  const std::string b = "2000,0,0,850,20,1\n";
  const std::string c = "0,0,2000,400,30,2\n";
  const SkyPlan one = plan_sky(of_points(folder, a + b + c), SkyForm::instances);
  const SkyPlan other = plan_sky(of_points(folder, c + b + a), SkyForm::instances);
  ASSERT_EQ(one.clouds.size(), 2u);
  ASSERT_EQ(other.clouds.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(one.clouds[i].name, other.clouds[i].name);
    EXPECT_EQ(one.clouds[i].size, other.clouds[i].size);
  }
  EXPECT_EQ(one.instances[0].cloud, other.instances[2].cloud);
}

// Levels of one cloud differ by what voxels can hold: of 128, 64 and 32 along the box. The thin parts of
// edges that coarse voxels miss were up to 3 % and 5.2 % of the mass.
TEST(SkyCloud, HasTheSameMassAndPlaceAtAllLevels) {
  for (const char* const seed : {"1", "2", "3"}) {
    const TemporaryFolder folder;
    SkyRecipe recipe = of_points(folder, std::string("0,0,0,900,0,") + seed + "\n0,0,-6000,900,0," + seed +
                                             "\n0,0,-20000,900,0," + seed + "\n");
    recipe.lod_from = Vec<3>(0.0, 0.0, 0.0);
    recipe.lod_angle = 0.25;
    recipe.voxel = 7.0;
    SkyPlan plan = plan_sky(recipe, SkyForm::instances);
    ASSERT_EQ(plan.clouds.size(), 3u);
    measure_densities(plan);
    std::vector<double> masses;
    std::vector<openvdb::BBoxd> boxes;
    for (const SkyCloud& cloud : plan.clouds) {
      const Volume volume = make_sky_cloud(cloud, "test");
      masses.push_back(mass(float_grid(volume)));
      boxes.push_back(
          float_grid(volume).transform().indexToWorld(float_grid(volume).evalActiveVoxelBoundingBox()));
    }
    for (std::size_t i = 1; i < 3; ++i) {
      EXPECT_NEAR(masses[i] / masses[0], 1.0, i == 1 ? 0.03 : 0.07) << "level " << i;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(boxes[i].min()[axis], boxes[0].min()[axis], 2.0 * 28.0);
        EXPECT_NEAR(boxes[i].max()[axis], boxes[0].max()[axis], 2.0 * 28.0);
      }
    }
  }
}

// Extinction per world unit: the thickest column has the recipe's depth, whatever the size, but for what
// coarser voxels average out of it (some 3 %).
TEST(SkyCloud, HasTheOpticalDepthOfTheRecipe) {
  const TemporaryFolder folder;
  SkyRecipe recipe = of_points(folder, "0,0,0,300,0,1\n5000,0,0,1200,0,1\n");
  recipe.cloud.density.optical_depth = 40.0;
  SkyPlan plan = plan_sky(recipe, SkyForm::instances);
  measure_densities(plan);
  ASSERT_EQ(plan.clouds.size(), 2u);
  for (const SkyCloud& cloud : plan.clouds)
    EXPECT_NEAR(thickest_column(float_grid(make_sky_cloud(cloud, "test")), 1), 40.0, 4.0);
}

TEST(SkyCloud, StandsOnTheOriginByTheMiddleOfItsFloor) {
  const TemporaryFolder folder;
  SkyRecipe recipe = of_points(folder, "0,0,0,900,0,1\n");
  recipe.cloud.box = {{3.0, 5.0, -0.8}, {5.0, 6.0, 0.8}};
  SkyPlan plan = plan_sky(recipe, SkyForm::grid);
  measure_densities(plan);
  const Volume volume = make_sky_cloud(plan.clouds.front(), "test");
  const openvdb::FloatGrid& grid = float_grid(volume);
  const openvdb::BBoxd box = grid.transform().indexToWorld(grid.evalActiveVoxelBoundingBox());
  EXPECT_NEAR(grid.voxelSize().x(), 10.0, 1e-9);
  EXPECT_GE(box.min().y(), -10.0);
  EXPECT_LE(box.max().y(), 460.0);
  EXPECT_GE(box.min().x(), -460.0);
  EXPECT_LE(box.max().x(), 460.0);
  EXPECT_LT(box.min().x(), -200.0);
  EXPECT_GT(box.max().x(), 200.0);
}

// The only cloud of a sky by itself, and the sky's grid.
std::pair<Volume, Volume> alone_and_placed(const SkyRecipe& recipe) {
  SkyPlan plan = plan_sky(recipe, SkyForm::grid);
  measure_densities(plan);
  return {make_sky_cloud(plan.clouds.front(), "test"), make_sky_grid(plan, {}, "test")};
}

// One cloud, moved by whole voxels: the grid is that of the cloud, moved, to a bit of interpolation (weights
// of 0 and 1 within 1e-6 of a voxel of steps of the largest density).
TEST(SkyGrid, EqualsACloudPlacedByHand) {
  const TemporaryFolder folder;
  const SkyRecipe recipe = of_points(folder, "500,-200,1000,900,0,1\n");
  const auto [alone, placed] = alone_and_placed(recipe);
  const openvdb::FloatGrid& cloud = float_grid(alone);
  auto in_sky = float_grid(placed).getConstAccessor();
  const double peak = measure(cloud).max();
  std::size_t compared = 0;
  for (auto voxel = cloud.cbeginValueOn(); voxel; ++voxel, ++compared) {
    const openvdb::Vec3d world = cloud.indexToWorld(voxel.getCoord()) + openvdb::Vec3d(500, -200, 1000);
    const openvdb::Vec3d index = float_grid(placed).worldToIndex(world);
    const openvdb::Coord nearest = openvdb::Coord::round(index);
    ASSERT_LT((index - nearest.asVec3d()).length(), 1e-6);
    EXPECT_NEAR(in_sky.getValue(nearest), *voxel, 1e-5 * peak);
  }
  EXPECT_GT(compared, 10000u);
  EXPECT_NEAR(mass(float_grid(placed)) / mass(cloud), 1.0, 1e-5);
}

// A turn by a quarter takes (x, y, z) to (z, y, -x): again whole voxels.
TEST(SkyGrid, TurnsAgainstTheClockAsSeenFromAbove) {
  const TemporaryFolder folder;
  const SkyRecipe recipe = of_points(folder, "0,0,0,900,90,1\n");
  const auto [alone, placed] = alone_and_placed(recipe);
  const openvdb::FloatGrid& cloud = float_grid(alone);
  auto in_sky = float_grid(placed).getConstAccessor();
  const double peak = measure(cloud).max();
  for (auto voxel = cloud.cbeginValueOn(); voxel; ++voxel) {
    const openvdb::Vec3d world = cloud.indexToWorld(voxel.getCoord());
    const openvdb::Vec3d turned(world.z(), world.y(), -world.x());
    EXPECT_NEAR(in_sky.getValue(openvdb::Coord::round(float_grid(placed).worldToIndex(turned))), *voxel,
                1e-4 * peak);
  }
}

// Masses add up, scaled, turned and off the voxels: linear interpolation keeps sums of what voxels resolve
// (0.1 % here; the bound is 10 times that).
TEST(SkyGrid, HasTheMassOfItsClouds) {
  const TemporaryFolder folder;
  SkyRecipe recipe =
      of_points(folder, "3,4,5,900,33,1\n2222,-7,77,850,200,1\n1111,0,5,500,17,2\n300,50,99,880,300,1\n");
  SkyPlan plan = plan_sky(recipe, SkyForm::grid);
  measure_densities(plan);
  ASSERT_EQ(plan.clouds.size(), 2u);
  double expected = 0.0;
  for (const SkyInstance& instance : plan.instances) {
    expected +=
        mass(float_grid(make_sky_cloud(plan.clouds[instance.cloud], "test"))) * std::pow(instance.scale, 3);
  }
  EXPECT_NEAR(mass(float_grid(make_sky_grid(plan, {}, "test"))) / expected, 1.0, 0.01);
}

TEST(SkyGrid, TilesAreDisjointAndTogetherTheWhole) {
  const TemporaryFolder folder;
  SkyRecipe recipe = of_points(folder, "3,4,5,900,33,1\n800,-7,77,850,200,2\n");
  recipe.voxel = 20.0;
  SkyPlan plan = plan_sky(recipe, SkyForm::grid);
  measure_densities(plan);
  const Volume whole = make_sky_grid(plan, {}, "test");
  std::uint64_t voxels = 0;
  double sum = 0.0;
  for (const double x : {-2000.0, 400.0}) {
    const Box<3> tile{{x, -2000.0, -2000.0}, {x < 0.0 ? 400.0 : 3000.0, 2000.0, 2000.0}};
    const SkyPlan inside = plan_in(plan, tile);
    const Volume part = make_sky_grid(inside, tile, "test");
    auto in_whole = float_grid(whole).getConstAccessor();
    for (auto voxel = float_grid(part).cbeginValueOn(); voxel; ++voxel)
      ASSERT_EQ(in_whole.getValue(voxel.getCoord()), *voxel);
    voxels += float_grid(part).activeVoxelCount();
    sum += mass(float_grid(part));
  }
  EXPECT_EQ(voxels, float_grid(whole).activeVoxelCount());
  EXPECT_NEAR(sum / mass(float_grid(whole)), 1.0, 1e-9);
}

TEST(SkyRecipe, IsTheSameAfterWritingAndReading) {
  SkyRecipe recipe = sky();
  recipe.lod_from = Vec<3>(1.0, 2.0, 3.0);
  recipe.description = "a sky";
  std::get<ScatteredPoints>(recipe.points).density = Layer{.weight = 0.5};
  const Json json = to_json(recipe);
  EXPECT_EQ(to_json(sky_recipe_from_json(json)), json);
}

TEST(SkyRecipe, RefusesWhatCannotBePlaced) {
  const auto refusal = [](const auto& change) {
    SkyRecipe recipe = sky();
    change(recipe);
    return message_of<std::invalid_argument>([&] { recipe.validate(); });
  };
  EXPECT_TRUE(
      refusal([](SkyRecipe& r) { r.cloud.shape = MeshShape{.file = "a.ply"}; }).starts_with("cloud.shape"));
  EXPECT_EQ(refusal([](SkyRecipe& r) { r.voxel = 0.0; }),
            "voxel is 0; it must be between 0.001 and 100000000 (world units)");
  EXPECT_EQ(refusal([](SkyRecipe& r) { r.cloud.density.optical_depth = -1.0; }),
            "cloud.scale.optical_depth is -1; it must be greater than 0");
  EXPECT_EQ(refusal([](SkyRecipe& r) { r.points = PointsFile{}; }),
            "points.file is empty; it must name a .csv or .ply");
  EXPECT_EQ(refusal([](SkyRecipe& r) { std::get<ScatteredPoints>(r.points).spacing = -1.0; }),
            "points.spacing is -1; it must be between 0 and 1000 (sizes)");
}

}  // namespace
}  // namespace solidnoise::sky_plan_test
