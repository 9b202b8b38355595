#include <stdexcept>

#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/volume/preview/preview.h"
#include "support/message_of.h"

namespace solidnoise::surface_preview_test {
namespace {

const PreviewOptions kSmall{.width = 120, .height = 90};

openvdb::FloatGrid::Ptr ball() {
  return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, openvdb::Vec3f(0), 0.05f);
}

// Stone is grey, the sky is blue.
bool is_sky(const Image& image, int x, int y) {
  return image.at(x, y, 0) < 0.85f * image.at(x, y, 2);
}

TEST(RenderSurface, ShowsABallAsOneUnderTheSun) {
  const Image image = render_surface(*ball(), kSmall);
  // A ball whose leaves fill 1 / 1.12 of the height, their corners included, is 55 to 85 of 90 pixels high.
  int height = 0;
  for (int y = 0; y < 90; ++y) height += !is_sky(image, 60, y);
  EXPECT_GE(height, 50);
  EXPECT_LE(height, 85);
  for (int x = 0; x < 120; ++x) {
    EXPECT_TRUE(is_sky(image, x, 0)) << x;
    EXPECT_TRUE(is_sky(image, x, 89)) << x;
  }
  // Opaque, lit from the upper left, and darkest at the lower right, which is in its own shadow.
  EXPECT_GT(image.at(50, 32, 0), 1.5f * image.at(76, 60, 0));
  EXPECT_FALSE(is_sky(image, 60, 45));
}

// Along the rows of a lit ball light changes evenly. Voxels are 8 pixels wide: slopes that jump between them
// are steps, 0.0024 in the mean of second differences.
TEST(RenderSurface, ShowsNoVoxelsOnASmoothSurface) {
  const Image image = render_surface(*ball(), {.width = 400, .height = 400});
  double sum = 0.0;
  int count = 0;
  for (int y = 120; y < 200; ++y) {
    for (int x = 120; x < 220; ++x) {
      sum += std::abs(image.at(x - 1, y, 0) - 2.0f * image.at(x, y, 0) + image.at(x + 1, y, 0));
      ++count;
    }
  }
  EXPECT_LT(sum / count, 3e-4);
}

TEST(RenderSurface, ShowsTheSkyAloneForAnEmptyGrid) {
  const auto empty = openvdb::createLevelSet<openvdb::FloatGrid>(0.1);
  const Image image = render_surface(*empty, kSmall);
  for (int y = 0; y < 90; ++y) EXPECT_TRUE(is_sky(image, 60, y));
}

TEST(RenderSurface, RefusesWhatIsNoLevelSet) {
  const auto fog = ball();
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  const auto refusal = message_of<std::invalid_argument>([&] { render_surface(*fog, kSmall); });
  EXPECT_NE(refusal.find("class is not level set"), std::string::npos);
  EXPECT_THROW(render_surface(*ball(), {.width = 1, .height = 90}), std::invalid_argument);
}

TEST(RenderSurface, StopsWhenAsked) {
  class Stop final : public Progress {
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(render_surface(*ball(), kSmall, &stop), Cancelled);
}

}  // namespace
}  // namespace solidnoise::surface_preview_test
