#include "solidnoise/volume/modify/distance_spline.h"

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/core/random.h"
#include "support/message_of.h"

namespace solidnoise::distance_spline_test {
namespace {

constexpr double kRadius = 1.0;
constexpr double kVoxel = 0.1;

openvdb::FloatGrid::Ptr sphere(float half_width = 3.0f) {
  return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      static_cast<float>(kRadius), openvdb::Vec3f(0.0f), static_cast<float>(kVoxel), half_width);
}

Vec<3> random_position(RandomStream& stream, double lowest, double highest) {
  while (true) {
    Vec<3> p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = 2.0 * highest * stream.next_unit() - highest;
    if (glm::length(p) >= lowest && glm::length(p) <= highest) return p;
  }
}

SmoothDistance::Jet jet_at(const SmoothDistance& distance, const Vec<3>& position) {
  SmoothDistance::Jet jet;
  distance.evaluate({&position, 1}, {&jet, 1});
  return jet;
}

// Of a grid with exact distances in a band that is wide enough: the distance and h^2/6 times its Laplacian,
// 2 / r, but for terms of fourth order.
TEST(DistanceSpline, OfASphereIsTheDistanceAndASixthOfTheLaplacian) {
  const DistanceSpline spline(sphere(9.0f), 0.4);
  RandomStream stream(1);
  for (int i = 0; i < 200; ++i) {
    const Vec<3> p = random_position(stream, 0.65, 1.35);
    const double r = glm::length(p);
    const auto jet = jet_at(spline, p);
    EXPECT_NEAR(jet.distance, r - kRadius + kVoxel * kVoxel / (3.0 * r), 2e-4);
    EXPECT_LT(glm::length(jet.gradient - (1.0 - kVoxel * kVoxel / (3.0 * r * r)) * p / r), 2e-3);
  }
}

TEST(DistanceSpline, DerivativesAreThoseOfTheDistance) {
  const DistanceSpline spline(sphere(), 0.4);  // rebuilt
  constexpr double kStep = 1e-4;
  RandomStream stream(1);
  for (int i = 0; i < 100; ++i) {
    const Vec<3> p = random_position(stream, 0.65, 1.35);
    const auto jet = jet_at(spline, p);
    for (int axis = 0; axis < 3; ++axis) {
      Vec<3> shift(0.0);
      shift[axis] = kStep;
      const auto above = jet_at(spline, p + shift);
      const auto below = jet_at(spline, p - shift);
      EXPECT_NEAR(jet.gradient[axis], (above.distance - below.distance) / (2.0 * kStep), 1e-5);
      for (int other = 0; other < 3; ++other) {
        // Third derivatives have steps where a voxel begins: of first order there.
        EXPECT_NEAR(jet.hessian[static_cast<std::size_t>(axis)][other],
                    (above.gradient[other] - below.gradient[other]) / (2.0 * kStep), 5e-3);
      }
    }
  }
}

TEST(DistanceSpline, KnowsDistancesBeyondTheLevelSetsOwnBand) {
  const DistanceSpline spline(sphere(), 0.8);
  for (const double r : {0.25, 0.5, 1.5, 1.75}) {
    // Rebuilt from the surface's polygons, which lie inside the sphere by about half of h^2 / R.
    EXPECT_NEAR(jet_at(spline, {0.0, r * 0.6, r * 0.8}).distance, r - kRadius + 0.01 / (3.0 * r) + 0.004,
                0.002)
        << r;
  }
  EXPECT_GE(jet_at(spline, {3.0, 0.0, 0.0}).distance, 0.8);
  EXPECT_GE(jet_at(spline, {1.0e6, 0.0, 0.0}).distance, 0.8);
}

TEST(DistanceSpline, RefusesWhatIsNoLevelSet) {
  const auto refusal = [](const openvdb::FloatGrid::Ptr& grid, double reach = 0.2) {
    return message_of<std::invalid_argument>([&] { DistanceSpline(grid, reach); });
  };
  const auto fog = sphere();
  fog->setName("smoke");
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  EXPECT_NE(refusal(fog).find("'smoke' is of class fog volume"), std::string::npos) << refusal(fog);

  const auto flat = sphere();
  flat->setTransform(std::make_shared<openvdb::math::Transform>(
      std::make_shared<openvdb::math::ScaleMap>(openvdb::Vec3d(0.1, 0.2, 0.1))));
  EXPECT_NE(refusal(flat).find("not cubes"), std::string::npos) << refusal(flat);

  // 626 bytes of a file that would take gigabytes to make a surface of.
  const auto tile = sphere();
  tile->tree().addTile(3, openvdb::Coord(1 << 20), -1.0f, true);
  EXPECT_NE(refusal(tile).find("has active tiles"), std::string::npos) << refusal(tile);

  EXPECT_NE(refusal(sphere(), 6.5).find("boundary_width is 6.5; it must be at most 6.4"), std::string::npos)
      << refusal(sphere(), 6.5);
  EXPECT_NE(refusal(sphere(), -1.0).find("boundary_width is -1"), std::string::npos);
}

}  // namespace
}  // namespace solidnoise::distance_spline_test
