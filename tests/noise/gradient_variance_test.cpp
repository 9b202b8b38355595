#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"

namespace solidnoise::gradient_variance_test {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

// The definition, for a spectrum that is the same in all directions: the integral of (2 pi f)^2 S / Dim.
template <int Dim>
double isotropic_gradient_variance(const Noise<Dim>& noise, double highest) {
  const double integral = integrate(
      [&](double f) {
        Vec<Dim> frequency(0.0);
        frequency[0] = f;
        return std::pow(f, Dim + 1) * noise.power_spectrum(frequency);
      },
      0.0, highest, 64);
  return kTau * kTau * unit_sphere_area(Dim) * integral / Dim;
}

template <int Dim>
double sum_of(const Vec<Dim>& v) {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) sum += v[axis];
  return sum;
}

// The compact kernel has a continuous slope and a step in its curvature: its power falls with f^-(n + 5), and
// what the integral leaves out above a frequency with the frequency's power -3: at 12 times F0 less than
// 1e-4.
TEST(GradientVariance, OfIsotropicGaborNoiseIsTheSecondMomentOfTheSpectrum) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.5, 1.0, 2.0}) {
      const GaborNoise<Dim> noise({.frequency = 1.5, .bandwidth = bandwidth});
      const Vec<Dim> variance = noise.gradient_variance();
      const double expected = isotropic_gradient_variance<Dim>(noise, 18.0);
      for (int axis = 0; axis < Dim; ++axis) {
        EXPECT_NEAR(variance[axis], expected, 2e-4 * expected) << Dim << ", bandwidth " << bandwidth;
      }
    }
  });
}

// power_spectrum() is that of the kernel of unlimited support, within options.error of the power.
TEST(GradientVariance, OfOrientedGaborNoiseIsTheSecondMomentOfTheSpectrum) {
  for_each_dimension([]<int Dim>() {
    if constexpr (Dim > 1) {
      const OrientedGaborNoise<Dim> noise({.frequency = 1.5, .error = 0.001});
      const double expected = isotropic_gradient_variance<Dim>(noise, 12.0);
      EXPECT_NEAR(noise.gradient_variance()[0], expected, 0.004 * expected) << Dim;
    }
  });
}

TEST(GradientVariance, OfGradientNoiseIsTheSecondMomentOfTheSpectrum) {
  for_each_dimension([]<int Dim>() {
    for (const auto kernel : {GradientNoiseOptions::Kernel::kensler, GradientNoiseOptions::Kernel::zero_dc}) {
      const GradientNoise<Dim> noise({.frequency = 1.5, .kernel = kernel});
      const double expected = isotropic_gradient_variance<Dim>(noise, 30.0);
      EXPECT_NEAR(noise.gradient_variance()[0], expected, 1e-6 * expected) << Dim;
    }
  });
}

TEST(GradientVariance, OfOctavesAndSlicesAddsUp) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.0};
  const double one = sum_of<3>(make_noise<3>(recipe)->gradient_variance());
  recipe.fractal = {.octaves = 3, .lacunarity = 2.0, .gain = 0.5};
  // The frequency doubles where the amplitude halves: each octave's gradient is as large as the first one's.
  const double power = 1.0 + 0.25 + 0.0625;
  EXPECT_NEAR(sum_of<3>(make_noise<3>(recipe)->gradient_variance()), 3.0 * one / power, 1e-6 * one);

  const std::shared_ptr<const Noise<4>> noise = make_noise<4>(recipe);
  const Vec<4> all = noise->gradient_variance();
  EXPECT_EQ(slice(noise, 0.3)->gradient_variance(), Vec<3>(all));
}

TEST(DirectionCone, SecondMomentsAreThoseOfTheDirectionsDrawn) {
  for_each_dimension([]<int Dim>() {
    for (const double anisotropy : {0.0, 0.4, 0.9, 1.0}) {
      Vec<Dim> axis(0.0);
      for (int i = 0; i < Dim; ++i) axis[i] = 1.0 + i;
      const DirectionCone<Dim> cone(axis, anisotropy);
      constexpr int kCount = 40000;
      RandomStream stream(11);
      Vec<Dim> sum(0.0);
      for (int i = 0; i < kCount; ++i) {
        const Vec<Dim> d = cone.draw(stream.next_unit(), stream);
        sum += d * d;
      }
      const Vec<Dim> expected = cone.second_moments();
      EXPECT_NEAR(sum_of<Dim>(expected), 1.0, 1e-12);
      // d^2 lies in [0, 1]: its standard deviation is at most 1/2, that of the mean 1/2 / 200; 4 of them.
      for (int i = 0; i < Dim; ++i) EXPECT_NEAR(sum[i] / kCount, expected[i], 0.01) << Dim << anisotropy;
    }
  });
}

}  // namespace
}  // namespace solidnoise::gradient_variance_test
