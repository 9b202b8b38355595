// What noises refuse, and how they say so: too little room for values, positions out of bounds, options that
// mean nothing.
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::refused_input_test {
namespace {

template <typename Action>
std::string refusal(const Action& action) {
  return message_of<std::invalid_argument>(action);
}

// A noise of each kind, and of each that is made of another.
std::vector<std::shared_ptr<const Noise<3>>> noises() {
  const auto gabor = std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.frequency = 1.0});
  return {gabor,
          std::make_shared<const OrientedGaborNoise<3>>(OrientedGaborNoiseOptions{.frequency = 1.0}),
          std::make_shared<const GradientNoise<3>>(GradientNoiseOptions{.frequency = 1.0}),
          make_noise<3>({.noise = GaborNoiseOptions{.frequency = 1.0}, .fractal = {.octaves = 2}}),
          move_noise<3>(gabor, {1.0, 2.0, 3.0}),
          slice(std::make_shared<const GaborNoise<4>>(GaborNoiseOptions{.frequency = 1.0}), 0.5),
          interpolate<3>(gabor, {.step = Vec<3>(0.01)}, 0.1)};
}

constexpr std::size_t kPoints = 8;

TEST(Samples, WithoutRoomForAllPointsAreRefused) {
  const std::vector<Vec<3>> positions(kPoints, Vec<3>(0.25));
  std::vector<float> values(kPoints);
  const std::span<float> all = values;
  for (const auto& noise : noises()) {
    EXPECT_NO_THROW(noise->evaluate(Points<3>{positions}, {all, {}}));
    EXPECT_EQ(refusal([&] {
                noise->evaluate(Points<3>{positions}, {all.first(kPoints - 1), {}});
              }),
              "values has room for 7 numbers; it must have room for 8");
    EXPECT_EQ(refusal([&] {
                noise->evaluate(Points<3>{positions}, {all, {all, all, all.first(kPoints - 1)}});
              }),
              "gradient has room for 7 numbers; it must have room for 8");
  }
}

TEST(Samples, WithoutRoomForALatticeAreRefused) {
  const Lattice<3> lattice{.step = Vec<3>(0.01), .count = {2, 2, 2}};
  std::vector<float> values(kPoints);
  const Samples<3> small{std::span(values).first(kPoints - 1), {}};
  for (const auto& noise : noises()) {
    EXPECT_EQ(refusal([&] { noise->evaluate(lattice, small); }),
              "values has room for 7 numbers; it must have room for 8");
    const auto block = noise->block(lattice.bounds());
    EXPECT_NO_THROW(block->evaluate(lattice, {values, {}}));
    EXPECT_EQ(refusal([&] { block->evaluate(lattice, small); }),
              "values has room for 7 numbers; it must have room for 8");
  }
}

TEST(Samples, WithoutRoomForAPlaneAreRefused) {
  const auto plane = on_plane(noises().front(), {{}, {0.6, 0.8, 0.0}, {0.0, 0.0, 1.0}});
  const std::vector<Vec<2>> positions(kPoints, Vec<2>(0.25));
  std::vector<float> values(kPoints);
  const std::span<float> all = values;
  EXPECT_EQ(refusal([&] {
              plane->evaluate(Points<2>{positions}, {all, {all, all.first(1)}});
            }),
            "gradient has room for 1 numbers; it must have room for 8");
}

TEST(Samples, WithoutRoomForPointsOfASurfaceAreRefused) {
  const std::vector<Vec<3>> positions(kPoints, Vec<3>(0.25));
  const std::vector<float> one(kPoints, 1.0f);
  const SurfacePoints surface{{positions}, {one, one, one}};
  std::vector<float> values(kPoints - 1);
  const auto expect_refused = [&](const auto& evaluate) {
    EXPECT_EQ(refusal(evaluate), "values has room for 7 numbers; it must have room for 8");
  };
  expect_refused([&] { SurfaceGaborNoise({}).evaluate(surface, {}, {values, {}}); });
  expect_refused([&] { ProjectedGradientNoise({}).evaluate(surface, {values, {}}); });
  expect_refused([&] { VaryingGaborNoise<3>({}).evaluate(Points<3>{positions}, {}, {values, {}}); });
}

// Of 2^40 cells nothing is left of a position in them but its first digits; of 2^63 they overflow.
TEST(Positions, ThatAreNotFiniteOrTooFarForTheNoiseAreRefused) {
  std::vector<float> values(1);
  for (const double far : {1e300, -1e300, 1e18, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    const std::vector<Vec<3>> positions{{0.5, far, 0.5}};
    const Lattice<3> lattice{.origin = positions.front(), .step = Vec<3>(0.01)};
    for (const auto& noise : noises()) {
      const std::string expected = "a position has a coordinate of ";
      EXPECT_EQ(refusal([&] {
                  noise->evaluate(Points<3>{positions}, {values, {}});
                }).substr(0, expected.size()),
                expected)
          << far;
      EXPECT_EQ(refusal([&] {
                  noise->evaluate(lattice, {values, {}});
                }).substr(0, expected.size()),
                expected)
          << far;
    }
  }
  const std::vector<Vec<3>> within{{1e9, -1e9, 0.0}};
  for (const auto& noise : noises()) EXPECT_NO_THROW(noise->evaluate(Points<3>{within}, {values, {}}));
}

template <typename Options>
std::string refused(const Options& options) {
  return refusal([&] { options.validate(); });
}

template <typename Options>
class NoiseOptions : public testing::Test {};
using AllOptions = testing::Types<GaborNoiseOptions, OrientedGaborNoiseOptions, GradientNoiseOptions,
                                  SurfaceGaborOptions, VaryingGaborOptions, ProjectedGradientOptions>;
TYPED_TEST_SUITE(NoiseOptions, AllOptions);

TYPED_TEST(NoiseOptions, FrequenciesThatOverflowAreRefused) {
  for (const double frequency : {0.0, 1e-308, 1e-13, 1e13, 1e300, 1e308}) {
    TypeParam options;
    options.frequency = frequency;
    EXPECT_NE(refused(options).find("between 1e-12 and 1000000000000 (cycles per world unit)"),
              std::string::npos)
        << frequency;
  }
}

TYPED_TEST(NoiseOptions, FewerImpulsesThanShowAreRefused) {
  if constexpr (requires(TypeParam options) { options.impulses; }) {
    for (const double impulses : {1e-308, 1e-6, 9e-4, 100001.0}) {
      TypeParam options;
      options.impulses = impulses;
      EXPECT_NE(refused(options).find("(mean impulses per kernel; 0 chooses"), std::string::npos) << impulses;
    }
    TypeParam options;
    options.impulses = 1e-6;
    EXPECT_EQ(refused(options),
              "impulses is 1e-06; it must be between 0.001 and 100000 (mean impulses per kernel; 0 chooses)");
  }
}

TYPED_TEST(NoiseOptions, DirectionsThatOverflowAreRefused) {
  if constexpr (requires(TypeParam options) { options.direction; }) {
    TypeParam options;
    options.direction[1] = 1e300;
    EXPECT_EQ(refused(options), "direction is 1e+300; it must be between -1000000000 and 1000000000");
  }
}

TEST(NoiseOptionsInRecipes, GainsAndFiltersThatOverflowAreRefused) {
  for (const double gain : {1e30, 1e308, 17.0, 0.0}) {
    EXPECT_EQ(refused(NoiseRecipe{.noise = GaborNoiseOptions{}, .fractal = {.octaves = 2, .gain = gain}})
                  .substr(0, 8),
              "gain is ")
        << gain;
  }
  EXPECT_EQ(refused(GaborNoiseOptions{.filter = 1e300}).substr(0, 16), "filter is 1e+300");
  EXPECT_EQ(refused(GaborNoiseOptions{.filter = 1e-300}).substr(0, 16), "filter is 1e-300");
}

TEST(NoiseOptionsInRecipes, OctavesBeyondAllFrequenciesAreRefused) {
  EXPECT_EQ(refused(NoiseRecipe{.noise = GaborNoiseOptions{.frequency = 1000.0},
                                .fractal = {.octaves = 16, .lacunarity = 4.0}}),
            "frequency is 1000, and 1.07374e+12 in the last of 16 octaves; it must be at most 1000000000000");
}

TEST(NoiseOptionsInRecipes, PeriodsOfMoreCellsThanCanBeCountedAreRefused) {
  const auto expect_refused = [](double period, std::string_view start) {
    EXPECT_EQ(refusal([&] { GaborNoise<3>({.period = Vec<4>(period)}); }).substr(0, start.size()), start);
    EXPECT_EQ(refusal([&] { OrientedGaborNoise<3>({.period = Vec<4>(period)}); }).substr(0, start.size()),
              start);
    GradientNoiseOptions gradient{.hash = GradientNoiseOptions::Hash::integer, .period = Vec<4>(period)};
    EXPECT_EQ(refusal([&] { GradientNoise<3>{gradient}; }).substr(0, start.size()), start);
  };
  expect_refused(0x1p64, "period is 1.8446744073709552e+19 along x");
  expect_refused(1e30, "period is 1e+30 along x");
  expect_refused(1e300, "period is 1e+300; it must be at most 1e+30 in size");
}

// Isotropic kernels of a narrow band in four dimensions look Gaussian from hundreds of thousands of impulses
// on.
TEST(NoiseOptionsInRecipes, ImpulsesAreNotChosenWithoutBound) {
  const NoiseRecipe narrow{.noise = GaborNoiseOptions{.bandwidth = 0.05}, .fractal = {}};
  EXPECT_EQ(refusal([&] { make_noise<4>(narrow); }).substr(0, 31), "bandwidth is 0.05, which takes ");
  EXPECT_NO_THROW(make_noise<3>(narrow));
}

}  // namespace
}  // namespace solidnoise::refused_input_test
