// How often noise by impulses in strata is far from 0: as often as a Gaussian.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/independent_values.h"
#include "support/scattered.h"
#include "support/spectra.h"

namespace solidnoise::tail_statistics_test {
namespace {

// A Poisson process of an excess kurtosis of 1/2 has 2 and 7 times as many values there.
class Tails {
 public:
  void add(const std::vector<float>& values) {
    for (const float value : values) {
      past_3_ += std::abs(value) > 3.0f ? 1.0 : 0.0;
      past_4_ += std::abs(value) > 4.0f ? 1.0 : 0.0;
    }
    count_ += static_cast<double>(values.size());
  }

  // Over 3 standard deviations within 10 %, over 4 within 40 %: three standard errors or more, of as many
  // values as are taken here.
  void expect_gaussian() const {
    const auto gaussian = [&](double sigmas) { return count_ * std::erfc(sigmas / std::numbers::sqrt2); };
    EXPECT_GT(count_, 1.9e6);
    EXPECT_NEAR(past_3_ / gaussian(3.0), 1.0, 0.1);
    EXPECT_NEAR(past_4_ / gaussian(4.0), 1.0, 0.4);
  }

 private:
  double past_3_ = 0.0;
  double past_4_ = 0.0;
  double count_ = 0.0;
};

// On lattices of many seeds, samples so far apart that they are nearly independent.
template <int Dim, typename Options>
void expect_gaussian_tails(Options options, int seeds) {
  SCOPED_TRACE(Dim);
  constexpr std::array kSide = {65536, 256, 48, 18};
  Tails tails;
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const auto noise = make_noise<Dim>(NoiseRecipe{options, {}});
    Lattice<Dim> lattice;
    lattice.step = Vec<Dim>(0.4 / options.frequency);
    lattice.count = glm::vec<Dim, int>(kSide[Dim - 1]);
    tails.add(values_of<Dim>(*noise, lattice));
  }
  tails.expect_gaussian();
}

TEST(TailStatistics, OfIsotropicNoiseAreAGaussians) {
  expect_gaussian_tails<1>(GaborNoiseOptions{}, 60);
  expect_gaussian_tails<2>(GaborNoiseOptions{}, 60);
  expect_gaussian_tails<3>(GaborNoiseOptions{}, 30);
  expect_gaussian_tails<4>(GaborNoiseOptions{}, 30);
}

TEST(TailStatistics, OfOrientedNoiseAreAGaussians) {
  expect_gaussian_tails<1>(OrientedGaborNoiseOptions{}, 60);
  expect_gaussian_tails<2>(OrientedGaborNoiseOptions{}, 60);
  expect_gaussian_tails<2>(OrientedGaborNoiseOptions{.anisotropy = 1.0}, 60);
  expect_gaussian_tails<3>(OrientedGaborNoiseOptions{}, 30);
  expect_gaussian_tails<4>(OrientedGaborNoiseOptions{}, 30);
}

TEST(TailStatistics, OfNoiseByExampleAreAGaussians) {
  for (const bool isotropic : {false, true}) {
    SpectrumNoiseOptions planar = some_spectrum(2, isotropic);
    planar.impulses = 0.0;
    expect_gaussian_tails<2>(planar, 60);
    SpectrumNoiseOptions solid = some_spectrum(3, isotropic);
    solid.impulses = 0.0;
    expect_gaussian_tails<3>(solid, 30);
  }
}

// A square of a plane in space through a place that depends on the number, with any normal.
Scattered<3> tilted_square(std::uint64_t number, double step) {
  constexpr int kSide = 256;
  RandomStream random(number);
  const auto n = random_direction<3>(random);
  const auto d = random_direction<3>(random);
  const Vec<3> normal(n[0], n[1], n[2]);
  const Vec<3> across = glm::normalize(glm::cross(normal, Vec<3>(d[0], d[1], d[2])));
  const Vec<3> along = glm::cross(across, normal);
  Scattered<3> square;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec<3> place =
        step * (static_cast<double>(i / kSide) * along + static_cast<double>(i % kSide) * across);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      square.offset[a].push_back(static_cast<float>(place[axis]));
      square.normal[a].push_back(static_cast<float>(normal[axis]));
      square.direction[a].push_back(static_cast<float>(along[axis]));
    }
  }
  return square;
}

TEST(TailStatistics, OnSurfacesAreAGaussians) {
  constexpr std::uint64_t kSeeds = 30;
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    Tails tails;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      SurfaceGaborOptions options{.frequency = 1.0, .waves = waves, .seed = seed};
      const Scattered<3> square = tilted_square(seed, 0.4);
      std::vector<float> values(square.size());
      SurfaceGaborNoise(options).evaluate(square.surface(), square.parameters(), {values, {}});
      tails.add(values);
    }
    tails.expect_gaussian();
  }
  Tails by_example;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SpectrumNoiseOptions options = some_spectrum(2);
    options.impulses = 0.0;
    options.seed = seed;
    const Scattered<3> square = tilted_square(seed, 0.4 / options.frequency);
    std::vector<float> values(square.size());
    const auto& tangent = square.direction;
    SurfaceSpectrumNoise(options, 0.5)
        .evaluate(square.surface(), {tangent[0], tangent[1], tangent[2]}, {values, {}});
    by_example.add(values);
  }
  by_example.expect_gaussian();
}

}  // namespace
}  // namespace solidnoise::tail_statistics_test
