#include "solidnoise/volume/sky/scatter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/message_of.h"

namespace solidnoise::scatter_test {
namespace {

ScatteredPoints some_points() {
  ScatteredPoints how;
  how.count = 600;
  how.area = {-9000.0, -6000.0, 11000.0, 8000.0};
  how.altitude = 900.0;
  how.altitude_spread = 50.0;
  how.smallest = 300.0;
  how.largest = 1500.0;
  how.spacing = 0.8;
  how.seed = 3;
  return how;
}

std::string refusal(const ScatteredPoints& how) {
  return message_of<std::invalid_argument>([&] { scatter(how, UpAxis::y); });
}

TEST(Scatter, MakesAsManyPointsAsAreAskedForWithinTheAreaAndTheSpread) {
  const std::vector<SkyPoint> points = scatter(some_points(), UpAxis::y);
  ASSERT_EQ(points.size(), 600u);
  for (const SkyPoint& p : points) {
    EXPECT_TRUE(p.x >= -9000.0 && p.x <= 11000.0 && p.z >= -6000.0 && p.z <= 8000.0);
    EXPECT_LE(std::abs(p.y - 900.0), 50.0);
    EXPECT_TRUE(p.turn >= 0.0 && p.turn < 360.0);
    EXPECT_FALSE(p.seed);
  }
}

TEST(Scatter, KeepsTheLeastDistanceOfEveryPair) {
  const std::vector<SkyPoint> points = scatter(some_points(), UpAxis::y);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = std::hypot(points[i].x - points[j].x, points[i].z - points[j].z);
      EXPECT_GE(apart, 0.8 * 0.5 * (points[i].size + points[j].size));
    }
  }
}

// Sizes are the quantiles (k + 1/2) / count: their distribution function is off by half a step at most.
TEST(Scatter, HasTheDistributionOfSizes) {
  for (const double exponent : {0.0, 1.0, 2.0}) {
    ScatteredPoints how = some_points();
    how.exponent = exponent;
    how.spacing = 0.2;
    std::vector<SkyPoint> points = scatter(how, UpAxis::y);
    std::reverse(points.begin(), points.end());
    const auto integral = [&](double s) {
      return exponent == 1.0 ? std::log(s) : std::pow(s, 1.0 - exponent) / (1.0 - exponent);
    };
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double below =
          (integral(points[k].size) - integral(300.0)) / (integral(1500.0) - integral(300.0));
      EXPECT_NEAR(below, (static_cast<double>(k) + 0.5) / 600.0, 1e-9);
    }
  }
}

// A map of 1/4 in one half and 1 in the other, of points that may stand anywhere: the number in the first
// half is binomial of 1/5. Five standard deviations: a false alarm in 2 million runs.
TEST(Scatter, FollowsTheMapOfTheDensity) {
  ScatteredPoints how = some_points();
  how.count = 4000;
  how.spacing = 0.0;
  Layer wave;
  wave.noise = NoiseRecipe{GaborNoiseOptions{.frequency = 1e-4}};
  wave.ramp = {{-1e-6, 0.25}, {1e-6, 1.0}};
  how.density = wave;
  const std::vector<SkyPoint> points = scatter(how, UpAxis::y);

  // Where the noise is negative, by the field itself, and how much of the area that is.
  const auto noise = make_noise<3>(noise_of_layer(wave.noise, NoiseRecipe{}));
  const auto part_below = [&](const std::vector<Vec<3>>& places) {
    std::vector<float> values(places.size());
    noise->evaluate(Points<3>{places}, {values, {}});
    return static_cast<double>(
               std::count_if(values.begin(), values.end(), [](float v) { return v < 0.0f; })) /
           static_cast<double>(places.size());
  };
  std::vector<Vec<3>> all;
  for (int i = 0; i < 400; ++i) {
    for (int j = 0; j < 400; ++j)
      all.emplace_back(-9000.0 + 20000.0 * (i + 0.5) / 400, 900.0, -6000.0 + 14000.0 * (j + 0.5) / 400);
  }
  const double area = part_below(all);
  const double expected = 0.25 * area / (0.25 * area + 1.0 - area);
  std::vector<Vec<3>> places;
  for (const SkyPoint& p : points) places.emplace_back(p.x, 900.0, p.z);
  ASSERT_GT(area, 0.05);
  ASSERT_LT(area, 0.95);
  EXPECT_NEAR(part_below(places), expected, 5.0 * std::sqrt(expected * (1.0 - expected) / 4000.0));
}

// Without a map, places are uniform: counts in 25 cells of a grid, chi-square of 24 degrees, whose 0.99999
// quantile is 68.
TEST(Scatter, IsUniformWithoutAMap) {
  ScatteredPoints how = some_points();
  how.count = 2500;
  how.spacing = 0.0;
  std::vector<int> cells(25);
  for (const SkyPoint& p : scatter(how, UpAxis::y)) {
    const int i = std::min(4, static_cast<int>((p.x + 9000.0) / 4000.0));
    const int j = std::min(4, static_cast<int>((p.z + 6000.0) / 2800.0));
    ++cells[static_cast<std::size_t>(5 * i + j)];
  }
  double chi_square = 0.0;
  for (const int count : cells) chi_square += (count - 100.0) * (count - 100.0) / 100.0;
  EXPECT_LT(chi_square, 68.0);
}

TEST(Scatter, IsTheSameEachTimeAndAnotherForAnotherSeed) {
  EXPECT_EQ(scatter(some_points(), UpAxis::y), scatter(some_points(), UpAxis::y));
  ScatteredPoints other = some_points();
  other.seed = 4;
  EXPECT_NE(scatter(some_points(), UpAxis::y), scatter(other, UpAxis::y));
}

TEST(Scatter, StandsOnTheGroundWithEitherAxisUp) {
  const std::vector<SkyPoint> upright = scatter(some_points(), UpAxis::z);
  for (const SkyPoint& p : upright) {
    EXPECT_LE(std::abs(p.z - 900.0), 50.0);
    EXPECT_TRUE(p.y >= -6000.0 && p.y <= 8000.0);
  }
}

TEST(Scatter, RefusesWhatCannotBe) {
  ScatteredPoints crowded = some_points();
  crowded.spacing = 8.0;
  EXPECT_NE(refusal(crowded).find("count is 600; there is room for"), std::string::npos) << refusal(crowded);
  ScatteredPoints turned = some_points();
  turned.area = {1.0, 0.0, -1.0, 1.0};
  EXPECT_EQ(refusal(turned),
            "area is 1 to -1 along its first side; its upper corner must lie beyond its lower one");
  ScatteredPoints sizes = some_points();
  sizes.largest = 100.0;
  EXPECT_EQ(refusal(sizes), "largest is 100; it must be at least smallest, 300 (world units)");
  ScatteredPoints many = some_points();
  many.count = 10'000'000;
  EXPECT_EQ(refusal(many), "count is 10000000; it must be between 1 and 100000");
  ScatteredPoints nowhere = some_points();
  nowhere.density = Layer{};
  nowhere.density->weight = 0.0;
  EXPECT_NE(refusal(nowhere).find("there is room for 0"), std::string::npos);
}

}  // namespace
}  // namespace solidnoise::scatter_test
