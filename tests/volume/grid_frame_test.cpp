#include "solidnoise/volume/topology/grid_frame.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace solidnoise::grid_frame_test {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

TEST(GridFrame, PutsVoxelCentresAtMultiplesOfTheVoxelSizeAsOpenVdbDoes) {
  const GridFrame frame(0.37);
  const Lattice<3> lattice = frame.lattice(CoordBBox(Coord(-16, 8, 1000), Coord(-9, 15, 1007)));
  const auto transform = frame.transform();
  for (int i = 0; i < 8; ++i) {
    const openvdb::Vec3d expected = transform->indexToWorld(Coord(-16 + i, 8 + i, 1000 + i));
    EXPECT_EQ(lattice.coordinate(0, i), expected.x());
    EXPECT_EQ(lattice.coordinate(1, i), expected.y());
    EXPECT_EQ(lattice.coordinate(2, i), expected.z());
  }
}

TEST(GridFrame, GivesAVoxelTheSamePositionInEveryRegion) {
  const GridFrame frame(0.1);
  const Lattice<3> one = frame.lattice(CoordBBox(Coord(0), Coord(100)));
  const Lattice<3> other = frame.lattice(CoordBBox(Coord(57), Coord(100)));
  for (int i = 57; i <= 100; ++i) EXPECT_EQ(one.coordinate(0, i), other.coordinate(0, i - 57));
}

TEST(GridFrame, FillsTheLongestSideWithExactlyDimVoxels) {
  const Box<3> box{{-1.1, -0.5, -0.25}, {1.1, 1.0, 0.8}};
  for (const int dim : {1, 7, 100, 256, 1000}) {
    const GridFrame frame(voxel_size_for_dim(box, dim));
    EXPECT_EQ(frame.voxels_in(box).dim().x(), dim);
  }
}

TEST(GridFrame, DividesTwoBoxesThatShareAFaceWithoutGapOrOverlap) {
  for (const double voxel : {0.1, 0.03, 1.0 / 7.0}) {
    const GridFrame frame(voxel);
    const CoordBBox whole = frame.voxels_in({{-1.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
    for (const double cut : {-0.3, 0.0, 0.1, 0.6}) {
      const CoordBBox left = frame.voxels_in({{-1.0, 0.0, 0.0}, {cut, 1.0, 1.0}});
      const CoordBBox right = frame.voxels_in({{cut, 0.0, 0.0}, {1.0, 1.0, 1.0}});
      EXPECT_EQ(left.max().x() + 1, right.min().x());
      EXPECT_EQ(left.volume() + right.volume(), whole.volume());
    }
  }
}

TEST(GridFrame, HasNoVoxelsInABoxThatIsTurnedRoundOrThinnerThanAVoxel) {
  const GridFrame frame(1.0);
  EXPECT_TRUE(frame.voxels_in({{1.0, 0.0, 0.0}, {-1.0, 2.0, 2.0}}).empty());
  EXPECT_TRUE(frame.voxels_in({{0.2, 0.0, 0.0}, {0.8, 2.0, 2.0}}).empty());
}

TEST(GridFrame, RefusesSizesAndPositionsThatNoGridCanHave) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(GridFrame(0.0), std::invalid_argument);
  EXPECT_THROW(GridFrame(-1.0), std::invalid_argument);
  EXPECT_THROW(GridFrame{nan}, std::invalid_argument);
  EXPECT_THROW(voxel_size_for_dim({{0, 0, 0}, {1, 1, 1}}, 0), std::invalid_argument);
  EXPECT_THROW(voxel_size_for_dim({{1, 1, 1}, {1, 1, 1}}, 10), std::invalid_argument);
  EXPECT_THROW(GridFrame(1e-6).voxels_in({{0, 0, 0}, {1e6, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(GridFrame(1.0).voxels_in({{0, 0, 0}, {nan, 1, 1}}), std::invalid_argument);
}

TEST(GridFrame, TakesOverATransformOfScaleAndTranslation) {
  openvdb::math::Transform transform(std::make_shared<openvdb::math::ScaleTranslateMap>(
      openvdb::Vec3d(0.5, 0.25, 0.125), openvdb::Vec3d(10, -20, 30)));
  const GridFrame frame(transform);
  EXPECT_EQ(frame.voxel_size(), Vec<3>(0.5, 0.25, 0.125));
  EXPECT_EQ(frame.origin(), Vec<3>(10, -20, 30));
  EXPECT_EQ(*frame.transform(), transform);
}

TEST(GridFrame, RefusesATransformThatRotatesOrMirrors) {
  const auto rotated = openvdb::math::Transform::createLinearTransform(1.0);
  rotated->postRotate(0.1, openvdb::math::Z_AXIS);
  EXPECT_THROW(GridFrame{*rotated}, std::invalid_argument);
  const auto mirrored = openvdb::math::Transform::createLinearTransform(1.0);
  mirrored->postScale(openvdb::Vec3d(1, -1, 1));
  EXPECT_THROW(GridFrame{*mirrored}, std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::grid_frame_test
