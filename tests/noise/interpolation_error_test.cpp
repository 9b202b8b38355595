// The error of interpolated noise is what the plan says, within the budget.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"
#include "support/lattices.h"

namespace solidnoise::interpolation_error_test {
namespace {

// Kernels and interpolation together, against the noise of unlimited kernels, summed in double precision,
// relative to its standard deviation: the error that a recipe asks for is split between them. Little blocks,
// of all phases, far from each other, and beside each a sample that is not interpolated: what is much more
// exact, or much less, would show as a pattern of the lattice.
template <template <int> class Noise, typename Options>
void expect_predicted_error(Options options, double samples_in_radius) {
  constexpr int kPlaces = 900;
  constexpr int kSide = 6;
  const ErrorBudget budget(options.error);
  const auto noise = std::make_shared<const Noise<3>>(with_truncation_share(options));
  const LatticeFrame<3> frame = frame_of<3>(support_of(*noise), samples_in_radius);
  const auto plan = InterpolationPlanner<3>(*noise, frame).plan(budget.interpolation).front();
  ASSERT_FALSE(plan.direct());
  const double predicted = std::sqrt(plan.error.truncation + plan.error.interpolation);
  EXPECT_LE(predicted, options.error);

  const auto interpolated = interpolate<3>(noise, frame, budget.interpolation);
  const auto kernel = kernel_reference(*noise);
  using Offset = reference::Position<3>;
  using Impulse = reference::Impulse<3>;
  const auto squared_error_at = [&](const Vec<3>& position, float value) {
    const double unlimited = reference::sum_impulses<3>(
        impulses_near(*noise, position, 2), Offset{},
        [&](const Offset& offset, const Impulse& impulse) { return kernel.unlimited(offset, impulse); });
    return std::pow(value - noise->amplitude() * unlimited, 2);
  };
  std::vector<double> squares;
  std::vector<double> squares_of_samples;
  const auto apart = static_cast<std::int64_t>(6.0 * samples_in_radius);
  for (int place = 0; place < kPlaces; ++place) {
    const Index<3> first(place % 30 * apart + place % 7, place / 30 * apart - place % 5, place % 11);
    const Lattice<3> lattice = lattice_of<3>(frame, first, kSide);
    const auto values = values_of<3>(*interpolated, lattice);
    for (std::size_t i = static_cast<std::size_t>(place) % 29; i < values.size(); i += 29) {
      squares.push_back(squared_error_at(sample_position(lattice, i), values[i]));
    }
    Index<3> sample = first;
    for (int axis = 0; axis < 3; ++axis)
      sample[axis] -= sample[axis] % plan.axes[static_cast<std::size_t>(axis)].step;
    const Lattice<3> one = lattice_of<3>(frame, sample, 1);
    squares_of_samples.push_back(
        squared_error_at(sample_position(one, 0), values_of<3>(*interpolated, one)[0]));
  }
  // Each place gives at least one independent error; with their excess kurtosis of a few the standard error
  // of the root mean square is at most 0.5 sqrt(2 + 1) / sqrt(900), under 3 %.
  const auto root_mean = [](const std::vector<double>& of) {
    return std::sqrt(estimate_mean(of, [](double x) { return x; }).mean);
  };
  const double measured = root_mean(squares);
  EXPECT_NEAR(measured, predicted, 0.1 * predicted);
  EXPECT_NEAR(root_mean(squares_of_samples), measured, 0.25 * measured);
}

TEST(InterpolationError, TotalErrorIsWithinATenthOfThePredictionAndMuchTheSameEverywhere) {
  for (const double error : {0.02, 0.05}) {
    for (const double radius : {16.0, 40.0}) {
      SCOPED_TRACE(testing::Message() << "error " << error << ", " << radius << " samples");
      expect_predicted_error<GaborNoise>(GaborNoiseOptions{.error = error, .impulses = 20.0, .seed = 3},
                                         radius);
      for (const double anisotropy : {0.0, 0.5, 1.0}) {
        expect_predicted_error<OrientedGaborNoise>(
            OrientedGaborNoiseOptions{.error = error, .impulses = 20.0, .anisotropy = anisotropy, .seed = 4},
            radius);
      }
    }
  }
}

// The gradient against that of the noise itself, whose kernels are so exact that what compact ones add to it,
// which coarse lattices smooth, is small beside the error; relative to the root mean square of its length.
// With samples of all phases over some 5000 kernels, and errors of neighbours alike, the measured root mean
// square is within a few per cent of the mean.
TEST(InterpolationError, ErrorOfTheGradientIsWithinATenthOfThePrediction) {
  for (const double error : {0.01, 0.04}) {
    for (const double radius : {30.0, 60.0}) {
      SCOPED_TRACE(testing::Message() << "error " << error << ", " << radius << " samples");
      const auto check = [&](const auto& noise) {
        const LatticeFrame<3> frame = frame_of<3>(support_of(*noise), radius);
        const auto plan = InterpolationPlanner<3>(*noise, frame).plan(error, Quantity::gradient).front();
        ASSERT_FALSE(plan.direct());
        const Vec<3> power = noise->gradient_variance();
        const double mean_square = power.x + power.y + power.z;
        const double predicted = std::sqrt(plan.error.interpolation / mean_square);
        EXPECT_LE(predicted, error);
        const auto interpolated = interpolate<3>(std::shared_ptr<const Noise<3>>(noise), frame, error);
        double sum = 0.0;
        constexpr int kPlaces = 60;
        constexpr int kSide = 48;
        for (int place = 0; place < kPlaces; ++place) {
          const Index<3> first(place * 400, place % 7, -place % 11);
          const Lattice<3> lattice = lattice_of<3>(frame, first, kSide);
          const auto made = evaluate_in_one_block<3>(*interpolated, lattice);
          const auto expected = evaluate_in_one_block<3>(*noise, lattice);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < lattice.size(); ++i) {
              sum += std::pow(double(made.gradient[axis][i]) - double(expected.gradient[axis][i]), 2);
            }
          }
        }
        const double measured = std::sqrt(sum / (kPlaces * std::pow(kSide, 3.0)) / mean_square);
        EXPECT_NEAR(measured, predicted, 0.1 * predicted);
      };
      check(std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.error = 2e-4, .impulses = 12.0}));
      check(std::make_shared<const OrientedGaborNoise<3>>(
          OrientedGaborNoiseOptions{.error = 2e-4, .impulses = 12.0, .anisotropy = 0.5}));
    }
  }
}

// What shading and surfaces follow is the difference of neighbours, which is small where waves are long. For
// kernels that are all but unlimited: of others, the lattice is without their ripples of high frequency.
TEST(InterpolationError, DifferencesOfNeighboursAreOfTheNoiseToo) {
  constexpr double kError = 0.01;
  for (const double radius : {16.0, 40.0, 115.0}) {
    const auto noise =
        std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.error = 0.001, .impulses = 20.0});
    const LatticeFrame<3> frame = frame_of<3>(support_of(*noise), radius);
    const auto interpolated = interpolate<3>(noise, frame, kError);
    constexpr int kSide = 150;
    const Lattice<3> lattice{frame.origin, frame.step, Index<3>(0), {kSide, kSide, 4}};
    const auto values = values_of<3>(*interpolated, lattice);
    const auto expected = values_of<3>(*noise, lattice);
    constexpr std::size_t kNext = 4 * kSide;  // the neighbour along the first axis
    double errors = 0.0;
    double differences = 0.0;
    for (std::size_t i = 0; i + kNext < values.size(); ++i) {
      const double difference = double(expected[i + kNext]) - double(expected[i]);
      differences += difference * difference;
      errors += std::pow(double(values[i + kNext]) - double(values[i]) - difference, 2);
    }
    EXPECT_GT(errors, 0.0);
    // The plan allows 5 times the error if those of neighbours knew nothing of each other; they are alike.
    EXPECT_LT(std::sqrt(errors / differences), 2.5 * kError) << radius;
  }
}

TEST(InterpolationError, LowOctavesLeaveTheBudgetToTheHighOnes) {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0, .impulses = 32.0}, {}};
  recipe.fractal.octaves = 4;
  const auto noise = make_noise<3>(recipe);
  constexpr double kVoxel = 1.0 / 90.0;  // of the longest waves
  const auto plans = InterpolationPlanner<3>(*noise, {Vec<3>(0.0), Vec<3>(kVoxel)}).plan(0.01);
  ASSERT_EQ(plans.size(), 4u);
  double total = 0.0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    total += plans[k].error.interpolation;
    if (k == 0) continue;
    EXPECT_LE(plans[k].axes[0].step, plans[k - 1].axes[0].step);
    EXPECT_GE(plans[k].error.interpolation, plans[k - 1].error.interpolation);
  }
  EXPECT_GE(plans.front().axes[0].step, 8);
  // No more than is allowed, for the sake of differences of neighbours here, and most of it.
  const Vec<3> neighbour(kVoxel, 0.0, 0.0);
  const double allowed = 1e-4 * 25.0 * (1.0 - noise->covariance(neighbour));
  EXPECT_LT(allowed, 1e-4);
  EXPECT_LE(total, allowed);
  EXPECT_GE(total, 0.25 * allowed);
}

TEST(ErrorBudget, PartsMakeTheWhole) {
  for (const double error : {1e-4, 0.001, 0.02, 0.5}) {
    const ErrorBudget budget(error);
    EXPECT_NEAR(std::hypot(budget.truncation, budget.interpolation), error, 1e-12);
  }
}

}  // namespace
}  // namespace solidnoise::interpolation_error_test
