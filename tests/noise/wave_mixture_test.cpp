#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"
#include "support/spectra.h"

namespace solidnoise::wave_mixture_test {
namespace {

// Some displacements, from nothing to a few waves.
template <int Dim>
std::vector<Vec<Dim>> some_displacements(double wavelength) {
  const Vec<4> direction(0.7, -0.4, 0.5, 0.31);
  std::vector<Vec<Dim>> displacements;
  for (const double length : {0.0, 0.2, 0.5, 0.9, 1.6, 2.3}) {
    displacements.push_back(length * wavelength * Vec<Dim>(direction));
  }
  return displacements;
}

// The mixture leaves out that kernels are compact: by the Cauchy-Schwarz inequality, less than twice their
// error and its square; in fact less than the error.
TEST(WaveMixture, OfIsotropicNoiseIsTheTransformOfItsSpectrumWithinTheError) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.5, 1.0, 2.0}) {
      for (const double error : {1e-3, 0.02, 0.1}) {
        const GaborNoise<Dim> noise({.frequency = 1.3, .bandwidth = bandwidth, .error = error});
        for (double r = 0.0; r < 4.0; r += 0.25) {
          const auto shell = [&](double f) {
            Vec<Dim> frequency(0.0);
            frequency[0] = f;
            return unit_sphere_area(Dim) * std::pow(f, Dim - 1) * noise.power_spectrum(frequency) *
                   mean_cosine(Dim, 2.0 * std::numbers::pi * f * r);
          };
          const double transform = integrate(shell, 0.0, 13.0, 52);
          Vec<Dim> x(0.0);
          x[0] = r;
          EXPECT_NEAR(noise.covariance(x), transform, error) << bandwidth << " at " << r;
        }
      }
    }
  });
}

TEST(WaveMixture, OfOneDirectionIsTheKernelsAutocorrelation) {
  for_each_dimension([]<int Dim>() {
    const OrientedGaborNoise<Dim> noise(
        {.frequency = 2.0, .anisotropy = 1.0, .direction = Vec<4>(0.6, -0.3, 1.0, 0.7)});
    for (const Vec<Dim>& x : some_displacements<Dim>(0.5)) {
      EXPECT_NEAR(noise.covariance(x), noise.kernel().autocorrelation(x) / noise.kernel().energy(), 1e-12);
    }
  });
}

// The quadrature over a cone against random directions of it: within 4 standard errors, of which there are at
// most 1 / sqrt(count) of the variance.
TEST(WaveMixture, OfAConeIsTheMeanOverItsDirections) {
  for_each_dimension([]<int Dim>() {
    constexpr int kCount = 40000;
    for (const double anisotropy : {0.0, 0.3, 0.8}) {
      const OrientedGaborNoise<Dim> noise(
          {.frequency = 1.0, .anisotropy = anisotropy, .direction = Vec<4>(0.6, -0.3, 1.0, 0.7)});
      for (const Vec<Dim>& x : some_displacements<Dim>(1.0)) {
        RandomStream stream(5);
        double mean = 0.0;
        for (int i = 0; i < kCount; ++i) {
          mean += std::cos(2.0 * std::numbers::pi *
                           glm::dot(noise.directions().draw(stream.next_unit(), stream), x)) /
                  kCount;
        }
        const double envelope =
            std::exp(-0.5 * std::numbers::pi * std::pow(noise.kernel().a() * glm::length(x), 2));
        EXPECT_NEAR(noise.covariance(x), mean * envelope, 4.0 / std::sqrt(kCount));
      }
    }
  });
}

TEST(WaveMixture, OfANoiseByExampleIsItsSpectrumsCovariance) {
  for (const bool isotropic : {false, true}) {
    const SpectrumNoise<3> noise(some_spectrum(3, isotropic));
    for (const Vec<3>& x : some_displacements<3>(0.5 / noise.band().upper)) {
      EXPECT_NEAR(noise.covariance(x), noise.spectrum().covariance(x), 1e-5);
    }
  }
}

// What is measured, of a noise with parts, moved, and a frame: places far from each other are independent,
// and the mean of products over them has the standard error that they show. The compact kernels may add twice
// their error.
TEST(WaveMixture, IsTheMeasuredCovariance) {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0, .impulses = 20.0}, {}};
  recipe.fractal.octaves = 2;
  const std::shared_ptr<const Noise<4>> in_time = make_noise<4>(recipe);
  const std::shared_ptr<const Noise<3>> frame = slice(in_time, 0.3);
  const std::shared_ptr<const Noise<3>> moved = move_noise<3>(make_noise<3>(recipe), Vec<3>(0.1, 7.3, -2.0));
  for (const auto& noise : {frame, moved}) {
    EXPECT_NEAR(noise->covariance(Vec<3>(0.0)), 1.0, 1e-6);
    const Lattice<3> lattice = independent_lattice<3>(2.0);
    const auto values = values_of<3>(*noise, lattice);
    for (const Vec<3>& x : some_displacements<3>(0.4)) {
      Lattice<3> displaced = lattice;
      displaced.origin += x;
      const auto others = values_of<3>(*noise, displaced);
      std::vector<double> products;
      for (std::size_t i = 0; i < values.size(); ++i) {
        products.push_back(static_cast<double>(values[i]) * static_cast<double>(others[i]));
      }
      const Estimate measured = estimate_mean(products, [](double product) { return product; });
      EXPECT_NEAR(measured.mean, noise->covariance(x), 4.0 * measured.error + 2e-3);
    }
  }
}

// Of both symmetries, with and without an envelope: derivatives by differences, whose own error is about h^2
// times the fourth derivative, under 1e-4 of the second.
TEST(WaveMixture, AlongAnAxisHasTheDerivativesOfTheCovariance) {
  using Mixture = WaveMixture<3>;
  Mixture mixture;
  mixture.waves = {{0.7, Vec<3>(0.3, -0.9, 0.2)}, {0.4, Vec<3>(-0.5, 0.1, 0.8)}};
  constexpr double kStep = 0.13;
  constexpr double kH = 1e-3;
  for (const auto symmetry : {Mixture::Symmetry::point, Mixture::Symmetry::mirror}) {
    for (const double a : {0.0, 0.6}) {
      mixture.symmetry = symmetry;
      mixture.a = a;
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](int k, int other, double offset) {
          Vec<3> x(0.0);
          x[axis] = k * kStep;
          x[other] += offset;
          return mixture.covariance(x);
        };
        const auto minus_second = [&](int k, int other) {
          return (2.0 * at(k, other, 0.0) - at(k, other, kH) - at(k, other, -kH)) / (kH * kH);
        };
        const AxisCovariance along = mixture.along(axis, kStep, 9);
        for (int k = 0; k < 9; ++k) {
          const auto i = static_cast<std::size_t>(k);
          EXPECT_NEAR(along.value[i], at(k, axis, 0.0), 1e-12);
          EXPECT_NEAR(along.value_to_slope[i], (at(k, axis, kH) - at(k, axis, -kH)) / (2.0 * kH), 1e-3);
          EXPECT_NEAR(along.slope[i], minus_second(k, axis), 1e-3);
          EXPECT_NEAR(along.lateral[i], minus_second(k, (axis + 1) % 3) + minus_second(k, (axis + 2) % 3),
                      2e-3);
        }
      }
    }
  }
}

TEST(WaveMixture, OfGradientNoiseIsEmpty) {
  EXPECT_TRUE(make_noise<3>({GradientNoiseOptions{}, {}})->waves().waves.empty());
}

}  // namespace
}  // namespace solidnoise::wave_mixture_test
