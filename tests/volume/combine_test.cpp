#include "solidnoise/volume/modify/combine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/field/pointwise_field.h"
#include "support/message_of.h"

namespace solidnoise::combine_test {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

FloatGrid::Ptr cube(float value, openvdb::GridClass grid_class) {
  FloatGrid::Ptr grid = FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      for (int k = 0; k < 10; ++k) grid->tree().setValueOn(Coord(i, j, k), value);
    }
  }
  grid->setGridClass(grid_class);
  return grid;
}

// Values that tell the voxel: 0 to 0.999.
FloatGrid::Ptr ramp() {
  FloatGrid::Ptr grid = cube(0.0f, openvdb::GRID_FOG_VOLUME);
  for (auto value = grid->beginValueOn(); value; ++value) {
    const Coord x = value.getCoord();
    value.setValue(0.1f * static_cast<float>(x.x()) + 0.01f * static_cast<float>(x.y()) +
                   0.001f * static_cast<float>(x.z()));
  }
  return grid;
}

constexpr openvdb::GridClass kFog = openvdb::GRID_FOG_VOLUME;
constexpr openvdb::GridClass kUnknown = openvdb::GRID_UNKNOWN;

// The one value of a cube of `value` after combination with a noise that is `noise` everywhere.
float combined(float value, float noise, const Combination& combination,
               openvdb::GridClass grid_class = kFog) {
  const FloatGrid::Ptr grid = cube(value, grid_class);
  grid->tree().setValueOn(Coord(9, 9, 9), 1.0f);  // the peak
  combine_values(*grid, *cube(noise, kUnknown), combination);
  EXPECT_EQ(grid->activeVoxelCount(), 1000u);
  return grid->tree().getValue(Coord(3, 4, 5));
}

TEST(CombineValues, FollowsTheFormulas) {
  EXPECT_FLOAT_EQ(combined(0.5f, 0.25f, {Combine::replace, 9.0}), 0.25f);
  EXPECT_FLOAT_EQ(combined(0.5f, 0.25f, {Combine::add, 2.0}), 1.0f);
  EXPECT_FLOAT_EQ(combined(0.5f, 0.25f, {Combine::multiply, 2.0}), 0.75f);
  EXPECT_FLOAT_EQ(combined(0.5f, 0.25f, {Combine::multiply, -2.0}), 0.25f);
  EXPECT_FLOAT_EQ(combined(0.5f, 0.25f, {Combine::erode, 2.0}), 0.25f);
}

TEST(CombineValues, KeepsFogFromGoingUnderZeroAndNothingElse) {
  for (const Combine how : {Combine::replace, Combine::add, Combine::multiply}) {
    EXPECT_EQ(combined(0.5f, -3.0f, {how, 1.0}), 0.0f);
    EXPECT_LT(combined(0.5f, -3.0f, {how, 1.0}, kUnknown), 0.0f);
  }
}

TEST(CombineValues, ErodesThinPartsAndLeavesThePeak) {
  const Combination erode{Combine::erode, 1.0};
  EXPECT_EQ(combined(1.0f, 1.0f, erode), 1.0f);
  EXPECT_EQ(combined(0.4f, 1.0f, erode), 0.0f);
  EXPECT_EQ(combined(-0.5f, 1.0f, erode, kUnknown), -0.5f);  // no density that could be lowered
  float last_loss = 0.0f;
  for (const float value : {0.9f, 0.8f, 0.7f, 0.6f}) {
    const float result = combined(value, 0.3f, erode);
    EXPECT_GE(result, 0.0f);
    EXPECT_GT(value - result, last_loss);
    last_loss = value - result;
  }
  const FloatGrid::Ptr empty = cube(0.0f, kFog);
  const auto refusal = message_of<std::invalid_argument>([&] { combine_values(*empty, *empty, erode); });
  EXPECT_NE(refusal.find("nothing to erode"), std::string::npos) << refusal;
}

TEST(CombineValues, BlendsByTheMask) {
  const FloatGrid::Ptr mask_grid = ramp();  // 0 to 0.999, over the same voxels
  const GridMask mask(*mask_grid, "mask");
  const FloatGrid::Ptr grid = cube(0.5f, kFog);
  combine_values(*grid, *cube(2.0f, kUnknown), {Combine::replace, 1.0, &mask});
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const float factor = mask_grid->tree().getValue(value.getCoord());
    EXPECT_NEAR(*value, 0.5f + factor * 1.5f, 1e-6f);
    if (factor == 0.0f) {
      EXPECT_EQ(*value, 0.5f);
    }
  }
}

TEST(GridMask, InterpolatesFloatsAcrossTransformsAndClampsThem) {
  const FloatGrid::Ptr grid = ramp();
  const GridMask mask(*grid, "mask");
  EXPECT_FLOAT_EQ(mask.at({1.0, 2.0, 2.5}), 0.245f);  // voxel (2, 4, 5)
  EXPECT_FLOAT_EQ(mask.at({1.25, 2.0, 2.5}), 0.295f);
  EXPECT_EQ(mask.at({100.0, 0.0, 0.0}), 0.0f);
  const GridMask clamped(*cube(7.0f, kFog), "mask");
  EXPECT_EQ(clamped.at({1.0, 1.0, 1.0}), 1.0f);
  EXPECT_EQ(GridMask(*cube(-7.0f, kFog), "mask").at({1.0, 1.0, 1.0}), 0.0f);
}

TEST(GridMask, TakesTheInsideOfALevelSet) {
  const auto ball = openvdb::tools::createLevelSetSphere<FloatGrid>(1.0f, openvdb::Vec3f(0), 0.1f);
  const GridMask mask(*ball, "mask");
  EXPECT_EQ(mask.at({0.0, 0.0, 0.0}), 1.0f);
  EXPECT_EQ(mask.at({0.5, 0.0, 0.0}), 1.0f);
  EXPECT_NEAR(mask.at({1.0, 0.0, 0.0}), 0.5f, 0.02f);
  EXPECT_NEAR(mask.at({1.025, 0.0, 0.0}), 0.25f, 0.02f);
  EXPECT_EQ(mask.at({1.11, 0.0, 0.0}), 0.0f);
  EXPECT_EQ(mask.at({5.0, 0.0, 0.0}), 0.0f);
}

TEST(GridMask, TakesBoolsAndMasks) {
  const auto bools = openvdb::BoolGrid::create(false);
  bools->tree().setValueOn(Coord(1), true);
  bools->tree().setValueOn(Coord(3), false);
  EXPECT_EQ(GridMask(*bools, "mask").at({1.0, 1.0, 1.0}), 1.0f);
  EXPECT_EQ(GridMask(*bools, "mask").at({1.5, 1.0, 1.0}), 0.5f);
  EXPECT_EQ(GridMask(*bools, "mask").at({3.0, 3.0, 3.0}), 0.0f);
  const auto on = openvdb::MaskGrid::create();
  on->tree().addTile(1, Coord(0), true, true);
  EXPECT_EQ(GridMask(*on, "mask").at({4.0, 4.0, 4.0}), 1.0f);
  EXPECT_EQ(GridMask(*on, "mask").at({-1.0, 4.0, 4.0}), 0.0f);
}

TEST(GridMask, RefusesOtherGrids) {
  const auto refusal = [](const openvdb::GridBase& grid) {
    return message_of<std::invalid_argument>([&] { GridMask(grid, "in.vdb: grid 'm'"); });
  };
  const auto vectors = openvdb::Vec3SGrid::create();
  vectors->tree().setValueOn(Coord(1), openvdb::Vec3s(1));
  EXPECT_EQ(refusal(*vectors), "in.vdb: grid 'm' is of type vec3s; a mask must be of float, bool or mask");
  EXPECT_EQ(refusal(*FloatGrid::create()), "in.vdb: grid 'm' has no active voxels");
  const FloatGrid::Ptr broken = cube(1.0f, kFog);
  broken->tree().setValueOn(Coord(4, 5, 6), std::nanf(""));
  broken->tree().setValueOn(Coord(7, 5, 6), INFINITY);
  EXPECT_EQ(refusal(*broken),
            "in.vdb: grid 'm' has 2 values that are not finite, the first at voxel (4, 5, 6)");
}

TEST(RestPositions, InterpolatesBetweenActiveVoxelsOnly) {
  const auto grid = openvdb::Vec3DGrid::create();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->tree().setValueOn(Coord(0, 0, 0), openvdb::Vec3d(1, 2, 3));
  grid->tree().setValueOn(Coord(1, 0, 0), openvdb::Vec3d(3, 2, 3));
  const RestPositions rest(*grid, "rest");
  EXPECT_EQ(rest.at({0.0, 0.0, 0.0}), Vec<3>(1.0, 2.0, 3.0));
  EXPECT_EQ(rest.at({0.25, 0.0, 0.0}), Vec<3>(2.0, 2.0, 3.0));
  EXPECT_EQ(rest.at({0.25, 0.2, 0.0}), Vec<3>(2.0, 2.0, 3.0));  // not drawn towards the background's 0
  EXPECT_THROW(rest.at({9.0, 0.0, 0.0}), std::runtime_error);
  EXPECT_THROW(RestPositions(*cube(1.0f, kFog), "rest"), std::invalid_argument);
}

class Coordinates final : public PointwiseField {
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3>& p = points.positions[i];
      samples.values[i] = static_cast<float>(p.x + 10.0 * p.y + 100.0 * p.z);
    }
  }
};

TEST(FillGridAtPoints, EvaluatesAtVoxelsOfAnyTransform) {
  const FloatGrid::Ptr rotated = cube(1.0f, kFog);
  rotated->transform().postRotate(0.3, openvdb::math::Z_AXIS);
  const openvdb::math::NonlinearFrustumMap frustum(openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 3.0);
  const FloatGrid::Ptr tapered = cube(1.0f, kFog);
  tapered->setTransform(std::make_shared<openvdb::math::Transform>(frustum.copy()));
  for (const FloatGrid::Ptr& grid : {rotated, tapered}) {
    const FilledGrid filled = fill_grid_at_points(*grid, Coordinates(), nullptr);
    EXPECT_EQ(filled.moments.count(), 1000u);
    for (auto value = filled.grid->cbeginValueOn(); value; ++value) {
      const openvdb::Vec3d p = grid->indexToWorld(value.getCoord());
      ASSERT_NEAR(*value, p.x() + 10.0 * p.y() + 100.0 * p.z(), 1e-3);
    }
  }
}

TEST(FillGridAtPoints, LooksUpRestPositions) {
  const FloatGrid::Ptr grid = cube(1.0f, kFog);
  const auto rest_grid = openvdb::Vec3SGrid::create();
  rest_grid->setTransform(grid->transform().copy());
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const Coord x = value.getCoord();
    rest_grid->tree().setValueOn(x, openvdb::Vec3s(static_cast<float>(x.z()), 0, 0));
  }
  const RestPositions rest(*rest_grid, "rest");
  const FilledGrid filled = fill_grid_at_points(*grid, Coordinates(), &rest);
  for (auto value = filled.grid->cbeginValueOn(); value; ++value) {
    ASSERT_NEAR(*value, value.getCoord().z(), 1e-5);
  }
}

}  // namespace
}  // namespace solidnoise::combine_test
