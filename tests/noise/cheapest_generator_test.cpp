#include <cmath>
#include <stdexcept>
#include <variant>

#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise::cheapest_generator_test {
namespace {

template <int Dim>
void expect_impulses(double bandwidth, double isotropic, double oriented) {
  const GaborNoise<Dim> kernels(GaborNoiseOptions{.bandwidth = bandwidth});
  const OrientedGaborNoise<Dim> directions(OrientedGaborNoiseOptions{.bandwidth = bandwidth});
  EXPECT_NEAR(kernels.impulses_per_kernel(), isotropic, 0.5) << Dim;
  EXPECT_NEAR(directions.impulses_per_kernel(), oriented, 0.5) << Dim;
  EXPECT_LE(std::abs(kernels.excess_kurtosis()), 0.02);
  EXPECT_LE(std::abs(directions.excess_kurtosis()), 0.02);
}

// The table in the header.
TEST(CheapestGenerator, ImpulsesForTheSameLikenessToAGaussianField) {
  expect_impulses<1>(1.0, 5, 5);
  expect_impulses<2>(1.0, 23, 9);
  expect_impulses<3>(1.0, 53.2, 19);
  expect_impulses<4>(1.0, 204.2, 44.4);
  expect_impulses<3>(0.3, 982.6, 19);
  expect_impulses<4>(0.3, 9783.4, 44.4);
  expect_impulses<3>(2.0, 33.3, 19);
  expect_impulses<3>(4.0, 9.9, 19);
}

TEST(CheapestGenerator, IsRandomDirectionsInNarrowBandsAndKernelsInWideOnes) {
  for (int dimensions = 2; dimensions <= 4; ++dimensions) {
    NoiseRecipe recipe{GaborNoiseOptions{.bandwidth = 1.0}, {}};
    EXPECT_TRUE(
        std::holds_alternative<OrientedGaborNoiseOptions>(cheapest_generator(recipe, dimensions).noise))
        << dimensions;
  }
  const NoiseRecipe wide{OrientedGaborNoiseOptions{.bandwidth = 4.0}, {}};
  EXPECT_TRUE(std::holds_alternative<GaborNoiseOptions>(cheapest_generator(wide, 3).noise));
}

TEST(CheapestGenerator, KeepsTheSpectrumsPlaceAndWidthAndAllOptions) {
  GaborNoiseOptions options{.frequency = 3.0, .bandwidth = 1.5, .error = 0.01, .seed = 9};
  options.period = Vec<4>(8.0);
  options.evolution.rate = 0.5;
  options.filter = 0.01;
  NoiseRecipe recipe{options, {}};
  recipe.fractal.octaves = 4;
  const NoiseRecipe cheapest = cheapest_generator(recipe, 3);
  const auto& oriented = std::get<OrientedGaborNoiseOptions>(cheapest.noise);
  EXPECT_EQ(cheapest.fractal, recipe.fractal);
  EXPECT_EQ(oriented.frequency, 3.0);
  EXPECT_EQ(oriented.bandwidth, 1.5);
  EXPECT_EQ(oriented.error, 0.01);
  EXPECT_EQ(oriented.seed, 9u);
  EXPECT_EQ(oriented.period, options.period);
  EXPECT_EQ(oriented.evolution, options.evolution);
  EXPECT_EQ(oriented.filter, 0.01);
  EXPECT_EQ(oriented.anisotropy, 0.0);
  // The same recipe comes out of either.
  EXPECT_EQ(cheapest_generator(cheapest, 3), cheapest);

  // Both rings are as far out and as wide, to a tenth: their shapes differ.
  const GaborNoise<3> kernels(GaborNoiseOptions{.frequency = 3.0});
  const OrientedGaborNoise<3> directions(OrientedGaborNoiseOptions{.frequency = 3.0});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(directions.gradient_variance()[axis] / kernels.gradient_variance()[axis], 1.0, 0.1);
  }
}

TEST(CheapestGenerator, LeavesWhatItCannotChoose) {
  const NoiseRecipe uniform{GaborNoiseOptions{.weights = ImpulseWeights::uniform}, {}};
  EXPECT_EQ(cheapest_generator(uniform, 3), uniform);
  EXPECT_FALSE(has_generators(uniform));
  const NoiseRecipe streaks{OrientedGaborNoiseOptions{.anisotropy = 0.5}, {}};
  EXPECT_EQ(cheapest_generator(streaks, 3), streaks);
  const NoiseRecipe kensler{GradientNoiseOptions{}, {}};
  EXPECT_EQ(cheapest_generator(kensler, 3), kensler);
  EXPECT_THROW(cheapest_generator({GaborNoiseOptions{}, {}}, 5), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::cheapest_generator_test
