#include "solidnoise/volume/preview/matter_preview.h"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/volume/topology/topology.h"

namespace solidnoise::matter_preview_test {
namespace {

const PreviewOptions kSmall{.width = 80, .height = 60};

// A ball of one value, of radius 1.
openvdb::FloatGrid::Ptr ball(float value) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.08));
  const Topology topology = sphere_topology(GridFrame(0.08), Vec<3>(0.0), 1.0);
  for (auto voxel = topology.mask->cbeginValueOn(); voxel; ++voxel) {
    grid->tree().setValueOn(voxel.getCoord(), value);
  }
  return grid;
}

TEST(RenderFire, IsHotBeforeBlack) {
  const Image image = render_fire({ball(0.01f), ball(1500.0f), nullptr}, kSmall);
  for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(image.at(0, 0, channel), 0.0f);
  EXPECT_GT(image.at(40, 30, 0), 0.5f);
  EXPECT_GT(image.at(40, 30, 0), image.at(40, 30, 1));  // red before green, green before blue
  EXPECT_GT(image.at(40, 30, 1), image.at(40, 30, 2));
}

TEST(RenderFire, IsBrighterAndWhiterTheHotterItIs) {
  const Image cool = render_fire({ball(0.01f), ball(1100.0f), nullptr}, kSmall);
  const Image hot = render_fire({ball(0.01f), ball(2500.0f), nullptr}, kSmall);
  EXPECT_GT(hot.at(40, 30, 0), cool.at(40, 30, 0));
  EXPECT_GT(hot.at(40, 30, 2) / hot.at(40, 30, 0), 2.0f * cool.at(40, 30, 2) / cool.at(40, 30, 0));
}

TEST(RenderFire, IsDimmedBySmokeAndLessFlame) {
  const Image clear = render_fire({ball(0.01f), ball(1100.0f), nullptr}, kSmall);
  const Image smoky = render_fire({ball(20.0f), ball(1100.0f), nullptr}, kSmall);
  const Image faint = render_fire({ball(0.01f), ball(1100.0f), ball(0.1f)}, kSmall);
  EXPECT_LT(smoky.at(40, 30, 0), clear.at(40, 30, 0));
  EXPECT_LT(faint.at(40, 30, 0), clear.at(40, 30, 0));
}

TEST(RenderFire, LightsTheUpperLeftOfColdSmoke) {
  const Image image = render_fire({ball(20.0f), ball(300.0f), nullptr}, kSmall);
  EXPECT_GT(image.at(34, 22, 1), 1.3f * image.at(46, 38, 1));
}

TEST(RenderNebula, GlowsBeforeBlack) {
  const Image image = render_nebula(*ball(3.0f), kSmall);
  EXPECT_EQ(image.at(0, 0, 0), 0.0f);
  EXPECT_GT(image.at(40, 30, 0), 0.3f);
  const Image empty = render_nebula(*openvdb::FloatGrid::create(0.0f), kSmall);
  EXPECT_EQ(empty.at(40, 30, 0), 0.0f);
  EXPECT_THROW(render_nebula(*ball(1.0f), {.width = 1}), std::invalid_argument);
}

// A face of what is opaque within a voxel looks the same all over, wherever the steps of a ray fall.
TEST(RenderNebula, ShowsNoStepsOnADenseFace) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.08));
  grid->fill(openvdb::CoordBBox({0, 0, 0}, {24, 24, 24}), 40.0f);
  const Image image = render_nebula(*grid, {.width = 160, .height = 160});
  float least = 1.0f;
  float most = 0.0f;
  for (int y = 80; y < 100; ++y) {  // in the middle of the front
    for (int x = 60; x < 80; ++x) {
      least = std::min(least, image.at(x, y, 2));
      most = std::max(most, image.at(x, y, 2));
    }
  }
  EXPECT_LT(most - least, 0.02f);  // of 0.07 where each step counts as a whole
}

}  // namespace
}  // namespace solidnoise::matter_preview_test
