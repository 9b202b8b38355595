#include "solidnoise/volume/topology/topology.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/volume/topology/fill.h"
#include "support/wave_field.h"

namespace solidnoise::topology_test {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

TEST(BoxTopology, HasExactlyTheVoxelsOfTheBoxAndNoTiles) {
  const GridFrame frame(0.1);
  const Box<3> box{{-0.75, -2.05, 0.0}, {0.95, 1.15, 3.0}};
  const Topology topology = box_topology(frame, box);
  EXPECT_EQ(topology.voxel_bounds(), frame.voxels_in(box));
  EXPECT_EQ(topology.voxel_count(), frame.voxels_in(box).volume());
  EXPECT_FALSE(topology.mask->hasActiveTiles());
}

TEST(EllipsoidTopology, HasExactlyTheVoxelsWhoseCentresSatisfyItsEquation) {
  const GridFrame frame(0.25);
  const Vec<3> centre(1.0, -2.0, 0.1);
  const Vec<3> radii(3.0, 2.0, 4.1);
  const Topology topology = ellipsoid_topology(frame, centre, radii);
  std::uint64_t inside = 0;
  const CoordBBox around(Coord(-20), Coord(20));
  for (auto voxel = around.begin(); voxel; ++voxel) {
    const Vec<3> p = (Vec<3>((*voxel).x(), (*voxel).y(), (*voxel).z()) * 0.25 - centre) / radii;
    const bool expected = p.x * p.x + p.y * p.y + p.z * p.z <= 1.0;
    EXPECT_EQ(topology.mask->isValueOn(*voxel), expected) << *voxel;
    inside += expected;
  }
  EXPECT_EQ(topology.voxel_count(), inside);
}

TEST(SphereTopology, HasTheVolumeOfTheSphere) {
  const double voxel = 0.02;
  const Topology topology = sphere_topology(GridFrame(voxel), {0.123, 4.56, -7.89}, 0.8);
  const double volume = static_cast<double>(topology.voxel_count()) * voxel * voxel * voxel;
  const double exact = 4.0 / 3.0 * std::numbers::pi * 0.8 * 0.8 * 0.8;
  // Some 4 pi 40^2 = 20000 voxels lie on the surface; each is wrong by a fraction of deviation under 0.5, so
  // that their sum deviates by 71 voxels of 268000. Four times that is 0.1 %.
  EXPECT_NEAR(volume / exact, 1.0, 0.001);
}

TEST(SphereTopology, KeepsVoxelsThatLieExactlyOnTheSurface) {
  const Topology topology = sphere_topology(GridFrame(1.0), Vec<3>(0.0), 8.0);
  EXPECT_TRUE(topology.mask->isValueOn(Coord(8, 0, 0)));
  EXPECT_TRUE(topology.mask->isValueOn(Coord(0, -8, 0)));
  EXPECT_FALSE(topology.mask->isValueOn(Coord(8, 1, 0)));
}

TEST(Topologies, RefuseShapesThatHoldNoVoxel) {
  const GridFrame frame(1.0);
  EXPECT_THROW(box_topology(frame, {{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}}), std::invalid_argument);
  EXPECT_THROW(sphere_topology(frame, Vec<3>(0.5), 0.4), std::invalid_argument);
  EXPECT_THROW(sphere_topology(frame, Vec<3>(0.0), -1.0), std::invalid_argument);
  EXPECT_THROW(ellipsoid_topology(frame, Vec<3>(0.0), {1.0, 0.0, 1.0}), std::invalid_argument);
}

TEST(GridTopology, HasTheActiveVoxelsOfAGridOfAnyType) {
  const auto grid = openvdb::Vec3SGrid::create();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->tree().setValueOn(Coord(1, 2, 3), openvdb::Vec3s(1));
  grid->tree().setValueOff(Coord(100, 2, 3), openvdb::Vec3s(1));
  grid->tree().addTile(1, Coord(-8, -8, -8), openvdb::Vec3s(2), true);
  const Topology topology = grid_topology(*grid);
  EXPECT_EQ(topology.voxel_count(), 1u + 512u);
  EXPECT_EQ(topology.leaf_count(), 2u);  // the leaf without active voxels is not among them
  EXPECT_TRUE(topology.mask->isValueOn(Coord(1, 2, 3)));
  EXPECT_TRUE(topology.mask->isValueOn(Coord(-1, -1, -1)));
  EXPECT_FALSE(topology.mask->hasActiveTiles());
  EXPECT_EQ(topology.frame.voxel_size(), Vec<3>(0.5));
}

TEST(GridTopology, RefusesAGridWithoutActiveVoxels) {
  EXPECT_THROW(grid_topology(*openvdb::FloatGrid::create()), std::invalid_argument);
}

TEST(EstimateMemory, IsALittleMoreThanTheValuesOfTheLeaves) {
  const Topology topology = box_topology(GridFrame(0.1), {{0, 0, 0}, {6.4, 6.4, 6.4}});
  const FilledGrid filled = fill_grid(topology, WaveField(Vec<3>(1.0)), Sparsity::keep);
  const double values = 64.0 * 64.0 * 64.0 * sizeof(float);
  const auto estimate = static_cast<double>(estimate_memory(topology));
  // Masks, moments and malloc's bytes come to less than a fifth of the values.
  EXPECT_GT(estimate, 1.05 * values);
  EXPECT_LT(estimate, 1.20 * values);
  EXPECT_EQ(estimate_memory(topology), estimate_memory(topology.voxel_bounds()));
  EXPECT_EQ(estimate_memory(topology), estimate_memory(*filled.grid));
  const auto of_vectors = static_cast<double>(estimate_memory(topology, 3));
  EXPECT_GT(of_vectors, 1.05 * 3.0 * values);
  EXPECT_LT(of_vectors, 1.20 * 3.0 * values);
}

TEST(EstimateMemory, DoesNotOverflow) {
  EXPECT_GT(estimate_memory(CoordBBox(Coord(-(1 << 30)), Coord(1 << 30))), std::uint64_t{1} << 62);
  EXPECT_EQ(estimate_memory(CoordBBox()), 0u);
}

}  // namespace
}  // namespace solidnoise::topology_test
