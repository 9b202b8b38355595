// Noise that is interpolated at scattered points is the noise, within the error that the plan says, and
// depends on nothing but the position.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/interpolation/point_plan.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/lattices.h"

namespace solidnoise::point_interpolation_test {
namespace {

using NoisePtr = std::shared_ptr<const Noise<3>>;

std::vector<float> values_at(const Noise<3>& noise, const std::vector<Vec<3>>& positions) {
  std::vector<float> values(positions.size());
  noise.evaluate({positions}, {values, {}});
  return values;
}

// Points in a cube of so many samples.
std::vector<Vec<3>> scatter(const LatticeFrame<3>& frame, const Index<3>& first, double side, int count,
                            std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> within(0.0, side);
  std::vector<Vec<3>> positions;
  for (int i = 0; i < count; ++i) {
    const Vec<3> at(within(random), within(random), within(random));
    positions.push_back(frame.origin + frame.step * (Vec<3>(first) + at));
  }
  return positions;
}

double root_mean_square(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number * number;
  return std::sqrt(sum / static_cast<double>(numbers.size()));
}

std::vector<NoisePtr> exact_noises() {
  constexpr double kError = 2e-4;
  return {std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.error = kError, .impulses = 12.0}),
          std::make_shared<const OrientedGaborNoise<3>>(
              OrientedGaborNoiseOptions{.error = kError, .impulses = 12.0, .anisotropy = 0.5})};
}

// Some 300 cubes far from each other, whose errors are independent; their mean square has a standard error of
// 6 % or less where errors within a cube are alike, and 3 % is that of its root.
TEST(PointInterpolation, ErrorIsWithinATenthOfThePrediction) {
  constexpr int kPlaces = 300;
  constexpr int kPoints = 200;
  for (const NoisePtr& noise : exact_noises()) {
    for (const double error : {0.003, 0.01, 0.04}) {
      for (const double radius : {8.0, 20.0, 60.0}) {
        SCOPED_TRACE(testing::Message() << "error " << error << ", " << radius << " samples");
        const LatticeFrame<3> frame = frame_of<3>(noise->waves().radius, radius);
        const PointPlan plan = plan_points(*noise, frame, error).front();
        ASSERT_FALSE(plan.direct());
        EXPECT_LE(plan.squared_error, error * error);
        const NoisePtr interpolated = interpolate_at_points(noise, frame, error);
        std::vector<double> errors;
        for (int place = 0; place < kPlaces; ++place) {
          const Index<3> first(place % 20 * 500 - 4000, place / 20 * 400, -place % 13);
          const auto positions = scatter(frame, first, 12.0, kPoints, static_cast<std::uint64_t>(place));
          const auto values = values_at(*interpolated, positions);
          const auto expected = values_at(*noise, positions);
          for (int i = 0; i < kPoints; ++i) {
            const auto k = static_cast<std::size_t>(i);
            errors.push_back(double(values[k]) - double(expected[k]));
          }
        }
        const double predicted = std::sqrt(plan.squared_error);
        EXPECT_NEAR(root_mean_square(errors), predicted, 0.1 * predicted);
      }
    }
  }
}

// Of points a twentieth of a sample apart, as shading sees them, across the places where weights change.
TEST(PointInterpolation, DifferencesOfNeighboursAreOfTheNoiseToo) {
  constexpr double kError = 0.01;
  for (const NoisePtr& noise : exact_noises()) {
    for (const double radius : {20.0, 115.0}) {
      const LatticeFrame<3> frame = frame_of<3>(noise->waves().radius, radius);
      const NoisePtr interpolated = interpolate_at_points(noise, frame, kError);
      std::vector<Vec<3>> positions;
      for (int i = 0; i < 40000; ++i)
        positions.push_back(frame.origin + frame.step * Vec<3>(0.05 * i, 3.3, 7.7));
      const auto values = values_at(*interpolated, positions);
      const auto expected = values_at(*noise, positions);
      std::vector<double> errors;
      std::vector<double> differences;
      for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        differences.push_back(double(expected[i + 1]) - double(expected[i]));
        errors.push_back(double(values[i + 1]) - double(values[i]) - differences.back());
      }
      EXPECT_LT(root_mean_square(errors), 5.0 * kError * root_mean_square(differences)) << radius;
    }
  }
}

TEST(PointInterpolation, AValueDependsOnItsPositionOnly) {
  NoiseRecipe recipe{OrientedGaborNoiseOptions{.frequency = 2.0, .seed = 5}, {}};
  recipe.fractal.octaves = 3;
  const LatticeFrame<3> frame{Vec<3>(0.1, -0.2, 0.3), Vec<3>(0.01)};
  const NoisePtr noise = make_noise<3>(recipe);
  const NoisePtr interpolated = interpolate_at_points(noise, frame, 0.01);
  ASSERT_NE(interpolated, noise);
  const auto positions = scatter(frame, Index<3>(-40), 90.0, 5000, 1);
  const auto values = values_at(*interpolated, positions);

  // By themselves, in another order, of another noise that has not seen others, and beside gradients.
  const NoisePtr other = interpolate_at_points(make_noise<3>(recipe), frame, 0.01);
  for (std::size_t i = 0; i < positions.size(); i += 397) {
    EXPECT_EQ(values_at(*other, {positions[i]}).front(), values[i]);
  }
  std::vector<Vec<3>> backwards(positions.rbegin(), positions.rend());
  auto of_backwards = values_at(*interpolated, backwards);
  std::ranges::reverse(of_backwards);
  EXPECT_EQ(of_backwards, values);

  Evaluated<3> with_gradient(positions.size());
  interpolated->evaluate({positions}, with_gradient.samples());
  EXPECT_EQ(with_gradient.values, values);
  Evaluated<3> exact(positions.size());
  noise->evaluate({positions}, exact.samples());
  EXPECT_EQ(with_gradient.gradient, exact.gradient);
}

// Points all over, of which no few have samples in common: what there is room for is asked for by parts.
TEST(PointInterpolation, PointsMayBeFarFromEachOther) {
  const LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(0.05)};
  const NoisePtr noise =
      std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.frequency = 1.0, .impulses = 12.0});
  const NoisePtr interpolated = interpolate_at_points(noise, frame, 0.02);
  ASSERT_NE(interpolated, noise);
  const auto positions = scatter(frame, Index<3>(-50000000), 1e8, 20, 2);
  const auto values = values_at(*interpolated, positions);
  const auto expected = values_at(*noise, positions);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 0.2) << i;
}

TEST(PointInterpolation, IsNotDoneWherePointsSpreadTooFar) {
  const LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(0.05)};
  const NoisePtr noise =
      std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.frequency = 1.0, .impulses = 12.0});
  EXPECT_NE(interpolate_at_points(noise, frame, 0.02, {Vec<3>(0.5), 1.2}), noise);
  EXPECT_EQ(interpolate_at_points(noise, frame, 0.02, {Vec<3>(100.0), 1e4}), noise);
}

// Positions are multiples of a power of two, of which a whole number make the period.
TEST(PointInterpolation, RepeatsAfterThePeriod) {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 2.0, .period = Vec<4>(3.0, 3.0, 3.0, 0.0)}, {}};
  LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(1.0 / 64.0)};
  frame.period = glm::ivec3(192);
  const NoisePtr noise = make_noise<3>(recipe);
  const NoisePtr interpolated = interpolate_at_points(noise, frame, 0.02);
  ASSERT_NE(interpolated, noise);
  std::vector<Vec<3>> positions;
  std::vector<Vec<3>> after;
  for (int i = 0; i < 500; ++i) {
    positions.push_back(Vec<3>(i * 7 % 1024, i * 11 % 1024, i * 13 % 1024) / 1024.0);
    after.push_back(positions.back() + Vec<3>(3.0, -6.0, 9.0));
  }
  const auto values = values_at(*interpolated, positions);
  const auto repeated = values_at(*interpolated, after);
  // Impulses of another period are elsewhere, by a rounding of their positions.
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(repeated[i], values[i], 1e-4);
}

TEST(PointInterpolation, IsNotDoneWhereNothingIsGained) {
  const NoisePtr noise =
      std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.frequency = 1.0, .impulses = 12.0});
  EXPECT_EQ(interpolate_at_points(noise, {Vec<3>(0.0), Vec<3>(5.0)}, 0.01), noise);  // waves of a fifth
  EXPECT_EQ(interpolate_at_points(noise, {Vec<3>(0.0), Vec<3>(0.01)}, 0.0), noise);
  const NoisePtr gradient = make_noise<3>({GradientNoiseOptions{}, {}});
  EXPECT_EQ(interpolate_at_points(gradient, {Vec<3>(0.0), Vec<3>(0.01)}, 0.01), gradient);
}

}  // namespace
}  // namespace solidnoise::point_interpolation_test
