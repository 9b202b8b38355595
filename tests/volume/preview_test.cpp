#include "solidnoise/volume/preview/preview.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/volume/topology/fill.h"

namespace solidnoise::preview_test {
namespace {

// A ball of constant density, `scale` units wide.
openvdb::FloatGrid::Ptr ball(double scale, float density) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(scale / 40.0));
  const Topology topology = sphere_topology(GridFrame(scale / 40.0), Vec<3>(0.0), scale / 2);
  for (auto voxel = topology.mask->cbeginValueOn(); voxel; ++voxel) {
    grid->tree().setValueOn(voxel.getCoord(), density);
  }
  return grid;
}

double luminance(const Image& image, int x, int y) {
  return 0.2126 * image.at(x, y, 0) + 0.7152 * image.at(x, y, 1) + 0.0722 * image.at(x, y, 2);
}

// A white cloud is less blue than the sky: red against blue tells them apart.
bool is_sky(const Image& image, int x, int y) {
  return image.at(x, y, 0) < 0.85f * image.at(x, y, 2);
}

const PreviewOptions kSmall{.width = 120, .height = 90};

TEST(RenderPreview, PutsTheVolumeInTheMiddleWithSkyAllAround) {
  const Image image = render_preview(*ball(2.0, 60.0f), kSmall);
  ASSERT_EQ(image.width, 120);
  ASSERT_EQ(image.height, 90);
  ASSERT_EQ(image.channels, 3);
  int left = 120;
  int right = -1;
  int top = 90;
  int bottom = -1;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      EXPECT_TRUE(image.at(x, y) >= 0.0f && image.at(x, y) <= 1.0f);
      if (is_sky(image, x, y)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  EXPECT_NEAR(left + right, 119, 4);
  EXPECT_NEAR(top + bottom, 89, 4);
  EXPECT_GT(top, 2);
  EXPECT_GT(bottom - top, 45);  // more than half of the picture's height
  EXPECT_NEAR(right - left, bottom - top, 3);
}

// A ball half as large, framed by the large one, covers a quarter of what that does, to a pixel all around.
TEST(RenderPreview, IsFramedByTheGridThatIsNamed) {
  const openvdb::FloatGrid::Ptr large = ball(2.0, 60.0f);
  const auto covered = [](const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) count += !is_sky(image, x, y);
    }
    return count;
  };
  PreviewOptions framed = kSmall;
  framed.frame = large;
  const double all = covered(render_preview(*large, framed));
  EXPECT_EQ(all, covered(render_preview(*large, kSmall)));
  const double circumference = 2.0 * std::sqrt(std::numbers::pi * all);
  EXPECT_NEAR(covered(render_preview(*ball(1.0, 120.0f), framed)), all / 4.0, circumference / 2.0);
}

TEST(RenderPreview, LightsTheUpperLeftAndShadowsTheLowerRight) {
  const Image image = render_preview(*ball(2.0, 60.0f), kSmall);
  EXPECT_GT(luminance(image, 50, 32), luminance(image, 70, 58) + 0.2);
}

TEST(RenderPreview, IsTheSameForTheSameOpticalDepthAtAnySize) {
  const Image one = render_preview(*ball(1.0, 20.0f), kSmall);
  for (const float scale : {0.01f, 1000.0f}) {
    const Image other = render_preview(*ball(scale, 20.0f / scale), kSmall);
    double sum = 0.0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) sum += std::abs(one.pixels[i] - other.pixels[i]);
    // Rays that graze the ball's hard edge, or end where little light is left, differ by rounding; one wrong
    // factor of the size would change every pixel of the ball, a third of the picture.
    EXPECT_LT(sum / static_cast<double>(one.pixels.size()), 0.002) << scale;
  }
}

TEST(RenderPreview, LooksAtAVolumeWhoseUpAxisIsZFromItsOwnSide) {
  const auto slab = openvdb::FloatGrid::create(0.0f);
  slab->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
  slab->fill(openvdb::CoordBBox(openvdb::Coord(-20, -20, -2), openvdb::Coord(20, 20, 2)), 50.0f);
  const auto covered = [&](UpAxis up) {
    const Image image = render_preview(*slab, {.width = 60, .height = 60, .up = up});
    int pixels = 0;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) pixels += !is_sky(image, x, y);
    }
    return pixels;
  };
  // Flat on the ground it is seen from a little above; standing, it is seen from the front.
  EXPECT_LT(covered(UpAxis::z), 0.7 * covered(UpAxis::y));
}

TEST(RenderPreview, ShowsTheSkyAloneForAnEmptyGrid) {
  const Image image = render_preview(*openvdb::FloatGrid::create(0.0f), kSmall);
  EXPECT_TRUE(is_sky(image, 60, 45));
  EXPECT_LT(luminance(image, 60, 0), luminance(image, 60, 89));
}

TEST(RenderPreview, RefusesSizesOutOfRangeAndVoxelsThatAreNotCubes) {
  EXPECT_THROW(render_preview(*ball(1.0, 1.0f), {.width = 0}), std::invalid_argument);
  EXPECT_THROW(render_preview(*ball(1.0, 1.0f), {.height = 100000}), std::invalid_argument);
  const auto stretched = ball(1.0, 1.0f);
  stretched->setTransform(openvdb::math::Transform::Ptr(new openvdb::math::Transform(
      openvdb::math::MapBase::Ptr(new openvdb::math::ScaleMap(openvdb::Vec3d(1, 2, 1))))));
  EXPECT_THROW(render_preview(*stretched, kSmall), std::invalid_argument);
}

TEST(RenderPreview, StopsWhenAsked) {
  class Stop final : public Progress {
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(render_preview(*ball(1.0, 20.0f), kSmall, &stop), Cancelled);
}

}  // namespace
}  // namespace solidnoise::preview_test
