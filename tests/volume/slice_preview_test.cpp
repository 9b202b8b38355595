#include "solidnoise/volume/preview/slice_preview.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/volume/make_volume.h"

namespace solidnoise::slice_preview_test {
namespace {

// A volume of 40 x 20 x 12 voxels of the same vector everywhere, but for what `change` does.
template <typename Change>
Volume vectors(const Change& change) {
  const auto grid = openvdb::Vec3SGrid::create();
  const openvdb::CoordBBox box(openvdb::Coord(-20, -10, -6), openvdb::Coord(19, 9, 5));
  for (auto voxel = box.begin(); voxel; ++voxel) grid->tree().setValueOn(*voxel, change(*voxel));
  const auto moments = measure(*grid);
  return {{{grid, {moments.begin(), moments.end()}}}};
}

VolumeRecipe recipe_of(std::vector<Output> output, UpAxis up = UpAxis::y) {
  VolumeRecipe recipe;
  recipe.output = std::move(output);
  recipe.up = up;
  return recipe;
}

// Mean of the squared differences of neighbours, along x and along y.
std::pair<double, double> roughness(const Image& image) {
  double along_x = 0.0;
  double along_y = 0.0;
  for (int y = 0; y + 1 < image.height; ++y) {
    for (int x = 0; x + 1 < image.width; ++x) {
      along_x += std::pow(image.at(x + 1, y) - image.at(x, y), 2);
      along_y += std::pow(image.at(x, y + 1) - image.at(x, y), 2);
    }
  }
  return {along_x, along_y};
}

TEST(RenderSlice, HasTheSizeOfTheSliceThatIsLookedAt) {
  const Volume volume = vectors([](const openvdb::Coord&) { return openvdb::Vec3s(1.0f, 0.0f, 0.0f); });
  const Image upright = render_slice(volume, recipe_of({Output::curl}));
  EXPECT_EQ(upright.width, 480);
  EXPECT_EQ(upright.height, 240);
  const Image lying = render_slice(volume, recipe_of({Output::curl}, UpAxis::z));
  EXPECT_EQ(lying.width, 480);
  EXPECT_EQ(lying.height, 144);
}

TEST(RenderSlice, DrawsStreaksAlongTheVectors) {
  const auto [x_of_x, y_of_x] =
      roughness(render_slice(vectors([](const openvdb::Coord&) { return openvdb::Vec3s(1.0f, 0.0f, 0.5f); }),
                             recipe_of({Output::curl})));
  EXPECT_LT(5.0 * x_of_x, y_of_x);
  const auto [x_of_y, y_of_y] =
      roughness(render_slice(vectors([](const openvdb::Coord&) { return openvdb::Vec3s(0.0f, 1.0f, 0.5f); }),
                             recipe_of({Output::gradient})));
  EXPECT_LT(5.0 * y_of_y, x_of_y);
}

TEST(RenderSlice, ShowsColorsOfTheMiddleRightSideUp) {
  const Volume volume = vectors([](const openvdb::Coord& voxel) {
    return voxel.z() == 0 ? openvdb::Vec3s(voxel.x() >= 0, voxel.y() >= 0, 0.25f) : openvdb::Vec3s(0.0f);
  });
  VolumeRecipe recipe = recipe_of({Output::color});
  recipe.shaping = RawShaping{RawShaping::Range::unit};
  const Image image = render_slice(volume, recipe);
  EXPECT_FLOAT_EQ(image.at(400, 20, 0), 1.0f);  // right and above
  EXPECT_FLOAT_EQ(image.at(400, 20, 1), 1.0f);
  EXPECT_FLOAT_EQ(image.at(50, 220, 0), 0.0f);  // left and below
  EXPECT_FLOAT_EQ(image.at(50, 220, 1), 0.0f);
  EXPECT_FLOAT_EQ(image.at(50, 220, 2), 0.25f);
}

TEST(RenderSlice, RefusesValuesAndShowsNothingAsBlack) {
  const Volume nothing{{{openvdb::Vec3SGrid::create(), std::vector<Moments>(3)}}};
  EXPECT_THROW(render_slice(nothing, recipe_of({Output::value})), std::invalid_argument);
  for (const float pixel : render_slice(nothing, recipe_of({Output::curl})).pixels) EXPECT_EQ(pixel, 0.0f);
}

}  // namespace
}  // namespace solidnoise::slice_preview_test
