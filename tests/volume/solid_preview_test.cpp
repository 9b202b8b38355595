#include "solidnoise/volume/preview/solid_preview.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/volume/topology/topology.h"

namespace solidnoise::solid_preview_test {
namespace {

const PreviewOptions kSmall{.width = 80, .height = 60};

// A cube of 2 units: `inner` where all coordinates are under a half, `outer` in the rest of it.
openvdb::FloatGrid::Ptr cube(float inner, float outer) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.08));
  const Topology topology = box_topology(GridFrame(0.08), {Vec<3>(-1.0), Vec<3>(1.0)});
  for (auto voxel = topology.mask->cbeginValueOn(); voxel; ++voxel) {
    const openvdb::Coord at = voxel.getCoord();
    const bool is_inner = std::max({std::abs(at.x()), std::abs(at.y()), std::abs(at.z())}) < 7;
    grid->tree().setValueOn(at, is_inner ? inner : outer);
  }
  return grid;
}

SolidLook red_to_green() {
  return {ColorRamp({{0.0f, {1.0f, 0.0f, 0.0f}}, {1.0f, {0.0f, 1.0f, 0.0f}}})};
}

bool is_green(const Image& image, int x, int y) {
  return image.at(x, y, 1) > 2.0f * image.at(x, y, 0);
}
bool is_red(const Image& image, int x, int y) {
  return image.at(x, y, 0) > 2.0f * image.at(x, y, 1);
}

TEST(RenderSolid, HasTheColoursOfItsValuesOutside) {
  const Image image = render_solid(*cube(1.0f, 0.0f), nullptr, red_to_green(), kSmall);
  EXPECT_TRUE(is_red(image, 40, 30));
  EXPECT_NEAR(image.at(0, 0, 0), image.at(0, 0, 1), 0.1f);  // grey all around
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) EXPECT_FALSE(is_green(image, x, y));
  }
}

TEST(RenderSolid, ShowsItsInsideWhereItIsCut) {
  SolidLook look = red_to_green();
  look.is_cut = true;
  const Image image = render_solid(*cube(1.0f, 0.0f), nullptr, look, kSmall);
  EXPECT_TRUE(is_green(image, 40, 30));
  int red = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) red += is_red(image, x, y);
  }
  EXPECT_GT(red, 500);  // the outside of what is left
}

TEST(RenderSolid, IsWhereTheBodyIsOverHalfOfItsPeak) {
  const Image image = render_solid(*cube(1.0f, 0.0f), cube(8.0f, 3.0f), red_to_green(), kSmall);
  EXPECT_TRUE(is_green(image, 40, 30));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) EXPECT_FALSE(is_red(image, x, y));
  }
}

TEST(RenderSolid, ShowsNothingOfNothing) {
  const Image image = render_solid(*openvdb::FloatGrid::create(0.0f), nullptr, red_to_green(), kSmall);
  EXPECT_NEAR(image.at(40, 30, 0), image.at(40, 30, 1), 0.1f);
  EXPECT_THROW(render_solid(*cube(0.0f, 0.0f), nullptr, red_to_green(), {.height = 1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::solid_preview_test
