#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise::statistics_test {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

std::vector<float> integers(int count, float offset) {
  std::vector<float> values(static_cast<std::size_t>(count));
  std::iota(values.begin(), values.end(), offset);
  return values;
}

TEST(Moments, OfTheFirstIntegersAreThoseOfTheDiscreteUniformDistribution) {
  const double n = 1000;
  const Moments moments = Moments::of(integers(1000, 0.0f));
  EXPECT_EQ(moments.count(), 1000u);
  EXPECT_EQ(moments.min(), 0.0);
  EXPECT_EQ(moments.max(), 999.0);
  EXPECT_NEAR(moments.mean(), (n - 1) / 2, 1e-10);
  EXPECT_NEAR(moments.sigma(), std::sqrt((n * n - 1) / 12), 1e-10);
  EXPECT_NEAR(moments.skewness(), 0.0, 1e-12);
  EXPECT_NEAR(moments.excess_kurtosis(), -6.0 / 5.0 * (n * n + 1) / (n * n - 1), 1e-12);
}

TEST(Moments, OfASkewedSampleAreThoseOfTheBernoulliDistribution) {
  std::vector<float> values(1000, 0.0f);
  std::fill_n(values.begin(), 100, 1.0f);
  const double p = 0.1;
  const double q = 0.9;
  const Moments moments = Moments::of(values);
  EXPECT_NEAR(moments.mean(), p, 1e-14);
  EXPECT_NEAR(moments.sigma(), std::sqrt(p * q), 1e-14);
  EXPECT_NEAR(moments.skewness(), (q - p) / std::sqrt(p * q), 1e-12);
  EXPECT_NEAR(moments.excess_kurtosis(), (1 - 6 * p * q) / (p * q), 1e-11);
}

TEST(Moments, MergedFromPartsAreThoseOfTheWhole) {
  std::vector<float> values = integers(999, 0.0f);
  for (float& value : values) value = value * value * 1e-3f;  // skewed
  const Moments whole = Moments::of(values);
  Moments merged;
  const std::span<const float> span(values);
  for (const auto& [begin, count] : {std::pair{0, 1}, {1, 500}, {501, 0}, {501, 498}}) {
    merged.merge(Moments::of(span.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(count))));
  }
  EXPECT_EQ(merged.count(), whole.count());
  EXPECT_EQ(merged.min(), whole.min());
  EXPECT_EQ(merged.max(), whole.max());
  EXPECT_NEAR(merged.mean(), whole.mean(), 1e-12 * whole.mean());
  EXPECT_NEAR(merged.sigma(), whole.sigma(), 1e-12 * whole.sigma());
  EXPECT_NEAR(merged.skewness(), whole.skewness(), 1e-11);
  EXPECT_NEAR(merged.excess_kurtosis(), whole.excess_kurtosis(), 1e-11);
}

TEST(Moments, LoseNoDigitsToALargeMean) {
  Moments merged;
  for (int part = 0; part < 100; ++part) merged.merge(Moments::of(integers(10, 1e6f)));
  // Sums of plain squares would leave 1e12 * 2^-53 = 1e-4 of it.
  EXPECT_NEAR(merged.sigma(), std::sqrt(99.0 / 12.0), 1e-9);
}

TEST(Moments, OfNothingAndOfAConstantAreFinite) {
  EXPECT_EQ(Moments().sigma(), 0.0);
  EXPECT_EQ(Moments::of({}).count(), 0u);
  const Moments constant = Moments::of_constant(3.0f, 7);
  EXPECT_EQ(constant.mean(), 3.0);
  EXPECT_EQ(constant.sigma(), 0.0);
  EXPECT_EQ(constant.skewness(), 0.0);
  EXPECT_EQ(constant.excess_kurtosis(), 0.0);
}

// Active voxels x + 10 y + 100 z in a box, and a tile of 512 voxels of 5.
openvdb::FloatGrid::Ptr sample_grid() {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  const CoordBBox box(Coord(-20), Coord(20));
  for (auto voxel = box.begin(); voxel; ++voxel) {
    grid->tree().setValueOn(*voxel,
                            static_cast<float>((*voxel).x() + 10 * (*voxel).y() + 100 * (*voxel).z()));
  }
  grid->tree().addTile(1, Coord(64), 5.0f, true);
  return grid;
}

TEST(Measure, CountsActiveVoxelsAndTilesAndNothingElse) {
  const auto grid = sample_grid();
  grid->tree().setValueOff(Coord(40), 1e9f);
  const Moments moments = measure(*grid);
  const double n = 41.0 * 41.0 * 41.0;
  const double variance = (41.0 * 41.0 - 1) / 12.0 * (1 + 100 + 10000);  // of the box, its mean is 0
  const double mean = 512 * 5.0 / (n + 512);
  EXPECT_EQ(moments.count(), static_cast<std::uint64_t>(n) + 512);
  EXPECT_EQ(moments.max(), 2220.0);
  EXPECT_NEAR(moments.mean(), mean, 1e-10);
  EXPECT_NEAR(moments.sigma(), std::sqrt((n * variance + 512 * 25.0) / (n + 512) - mean * mean), 1e-8);
}

TEST(Measure, IsTheSameToTheBitForAnyNumberOfThreads) {
  const auto grid = sample_grid();
  const auto sigma_with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return measure(*grid).sigma();
  };
  EXPECT_EQ(sigma_with(1), sigma_with(4));
}

TEST(Measure, OfVectorsIsThatOfEachComponent) {
  const auto floats = sample_grid();
  const auto vectors = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.0f));
  vectors->topologyUnion(*floats);
  for (auto value = vectors->beginValueOn(); value; ++value) {
    const float v = floats->tree().getValue(value.getCoord());
    value.setValue({v, -2.0f * v, 1.0f});
  }
  const Moments expected = measure(*floats);
  const std::array<Moments, 3> moments = measure(*vectors);
  EXPECT_EQ(moments[0].mean(), expected.mean());
  EXPECT_EQ(moments[0].sigma(), expected.sigma());
  EXPECT_EQ(moments[1].max(), -2.0 * expected.min());
  EXPECT_EQ(moments[1].mean(), -2.0 * expected.mean());  // a power of two changes no digit
  EXPECT_EQ(moments[2].sigma(), 0.0);
  for (const Moments& component : moments) EXPECT_EQ(component.count(), expected.count());
}

TEST(Histogram, CountsEachActiveVoxelOnce) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  int x = 0;
  for (const float value : {-1.0f, 0.0f, 0.24f, 0.25f, 0.5f, 0.99f, 1.0f, 1.01f, std::nanf("")}) {
    grid->tree().setValueOn(Coord(x++, 0, 0), value);
  }
  const Histogram result = histogram(*grid, 0.0, 1.0, 4);
  EXPECT_EQ(result.counts, (std::vector<std::uint64_t>{2, 1, 1, 2}));
  EXPECT_EQ(result.below, 1u);
  EXPECT_EQ(result.above, 2u);
  EXPECT_THROW(histogram(*grid, 1.0, 1.0, 4), std::invalid_argument);
  EXPECT_THROW(histogram(*grid, 0.0, 1.0, 0), std::invalid_argument);
}

TEST(ThickestColumn, IsTheLargestIntegralAlongTheAxisInWorldUnits) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  for (int y = -10; y < 10; ++y) grid->tree().setValueOn(Coord(3, y, 4), 2.0f);
  for (int x = 0; x < 10; ++x) grid->tree().setValueOn(Coord(x, 0, 9), 3.0f);
  EXPECT_DOUBLE_EQ(thickest_column(*grid, 1), 20 * 2.0 * 0.5);
  EXPECT_DOUBLE_EQ(thickest_column(*grid, 0), 10 * 3.0 * 0.5);
  EXPECT_DOUBLE_EQ(thickest_column(*grid, 2), (2.0 + 3.0) * 0.5);  // where they cross, at x = 3, y = 0
  grid->tree().addTile(1, Coord(0, 64, 8), 7.0f, true);            // 8 voxels of 7 above that of 3
  EXPECT_DOUBLE_EQ(thickest_column(*grid, 1), (8 * 7.0 + 3.0) * 0.5);
  EXPECT_EQ(thickest_column(*openvdb::FloatGrid::create(), 1), 0.0);
  EXPECT_THROW(thickest_column(*grid, 3), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::statistics_test
