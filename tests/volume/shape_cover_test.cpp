#include "solidnoise/volume/shape_cover.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/grid_values.h"
#include "support/temporary_folder.h"

namespace solidnoise::shape_cover_test {
namespace {

// Of density 1 all over the shape.
VolumeRecipe solid(const Shape& shape, double voxel) {
  VolumeRecipe recipe;
  recipe.noise.noise = GaborNoiseOptions{.frequency = 1.0};
  recipe.shaping = RemapShaping{.floor = 1.0};
  recipe.density.factor = 1.0;
  recipe.shape = shape;
  recipe.box = {{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
  recipe.voxel = voxel;
  return recipe;
}

openvdb::FloatGrid::Ptr make(const VolumeRecipe& recipe) {
  return openvdb::gridPtrCast<openvdb::FloatGrid>(
      make_volume(recipe, plan_volume(recipe), "test").grids.front().grid);
}

double mass(const VolumeRecipe& recipe) {
  const Moments moments = measure(*make(recipe));
  return moments.mean() * static_cast<double>(moments.count()) * std::pow(*recipe.voxel, 3);
}

// The cover falls from 1 to 0 between r - e/2 and r + e/2, so that the mass is that of balls whose radii are
// uniform there: 4/3 pi (r^3 + r e^2 / 4). Counting centres is off by a percent and more at these voxels;
// with the cover what is left is the error of the sum over a lattice of a function with two kinks, some h^2.
TEST(ShapeCover, HasTheMassOfABall) {
  constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;
  for (const double voxel : {0.11, 0.0731, 0.05}) {
    EXPECT_NEAR(mass(solid(SphereShape{}, voxel)) / (kBall * (1.0 + voxel * voxel)), 1.0, 0.002) << voxel;
  }
  VolumeRecipe soft = solid(SphereShape{}, 0.05);
  soft.edge = 0.4;
  EXPECT_NEAR(mass(soft) / (kBall * (1.0 + 0.16 / 4.0)), 1.0, 0.001);
  VolumeRecipe in_voxels = solid(SphereShape{}, 0.05);
  in_voxels.edge_voxels = 8.0;
  EXPECT_EQ(mass(in_voxels), mass(soft));
}

TEST(ShapeCover, HasNoStepOverAHalf) {
  const auto grid = make(solid(SphereShape{}, 0.0731));
  const auto values = grid->getConstAccessor();
  float largest = 0.0f;
  for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        openvdb::Coord other = voxel.getCoord();
        other[axis] += side;
        largest = std::max(largest, std::abs(*voxel - values.getValue(other)));
      }
    }
  }
  EXPECT_LE(largest, 0.5f + 1e-5f);
  EXPECT_GT(largest, 0.4f);
}

// Distances to an ellipsoid are of first order, so that edges are a little wider where it bends; its mass is
// that of the ball, squeezed, and some 0.4 % for the width of its edge (as of the ball).
TEST(ShapeCover, HasTheMassOfAnEllipsoid) {
  VolumeRecipe recipe = solid(EllipsoidShape{}, 0.043);
  recipe.box = {{-1.0, -0.5, -0.7}, {1.0, 0.5, 0.7}};
  EXPECT_NEAR(mass(recipe) / (4.0 / 3.0 * std::numbers::pi * 0.35), 1.004, 0.005);
}

// The mass is the mean of the volumes of the bodies at distances s from the cube, uniform from -e/2 to e/2:
// of a side a outward a^3 + 6 a^2 s + 3 pi a s^2 + 4/3 pi s^3 (Steiner), inward (a - 2 s)^3. With E[s^2] =
// e^2 / 12 that is a^3 + 6 a (1 + pi / 4) e^2 / 12, but for terms of third order.
TEST(ShapeCover, HasTheMassOfAMesh) {
  const TemporaryFolder folder;
  folder.write("cube.obj",
               "v 0 0 0\nv 1.03 0 0\nv 1.03 1.03 0\nv 0 1.03 0\nv 0 0 1.03\nv 1.03 0 1.03\nv 1.03 1.03 1.03\n"
               "v 0 1.03 1.03\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const VolumeRecipe recipe = solid(MeshShape{folder.file("cube.obj")}, 0.1);
  const double expected = std::pow(1.03, 3) + 6.0 * 1.03 * (1.0 + std::numbers::pi / 4.0) * 0.04 / 12.0;
  EXPECT_NEAR(mass(recipe) / expected, 1.0, 0.01);
}

// A box is what tiles are cut of: it ends where it does, unless it is told otherwise.
TEST(ShapeCover, OfABoxIsWhatIsAskedFor) {
  VolumeRecipe recipe = solid(BoxShape{}, 0.1);
  EXPECT_EQ(make(recipe)->activeVoxelCount(), 8000u);
  EXPECT_NEAR(mass(recipe), 8.0, 1e-5);
  recipe.edge = 0.3;
  // Centres lie on the box's lower faces, and on its upper ones: each half covered.
  EXPECT_NEAR(mass(recipe), 8.0, 0.01);
  EXPECT_GT(make(recipe)->activeVoxelCount(), 8000u);
}

TEST(ShapeCover, IsNotOfRawNoise) {
  VolumeRecipe recipe = solid(SphereShape{}, 0.1);
  recipe.shaping = RawShaping{};
  recipe.density = {};
  EXPECT_EQ(make(recipe)->activeVoxelCount(),
            sphere_topology(GridFrame(0.1), Vec<3>(0.0), 1.0).voxel_count());
}

TEST(Prune, LeavesOutWhatIsBelowAPartOfTheLargestDensity) {
  VolumeRecipe recipe = solid(BoxShape{}, 0.05);
  recipe.shaping = RemapShaping{.threshold = -1.0, .softness = 2.0, .power = 4.0};
  recipe.density = {};
  const auto all = make(recipe);
  recipe.prune = 0.01;
  const auto kept = make(recipe);
  const double least = 0.01 * measure(*all).max();
  EXPECT_EQ(measure(*kept).max(), measure(*all).max());
  EXPECT_GE(measure(*kept).min(), least);
  std::uint64_t above = 0;
  for (auto voxel = all->cbeginValueOn(); voxel; ++voxel) above += *voxel >= static_cast<float>(least);
  EXPECT_EQ(kept->activeVoxelCount(), above);
  EXPECT_LT(above, all->activeVoxelCount());
}

}  // namespace
}  // namespace solidnoise::shape_cover_test
