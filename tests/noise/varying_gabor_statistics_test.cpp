// Moments, spectra and covariances of Gabor noise with parameters per point, against the closed forms.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"
#include "support/scattered.h"

namespace solidnoise::varying_gabor_statistics_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Points so far apart that no impulse is seen by two of them: their values are independent. Each has a
// neighbour at `lag` (0: none), which follows it.
template <int Dim>
Scattered<Dim> independent_points(std::size_t count, double distance, const Vec<Dim>& lag = Vec<Dim>(0.0)) {
  Scattered<Dim> result;
  const auto side = static_cast<std::size_t>(std::ceil(std::pow(static_cast<double>(count), 1.0 / Dim)));
  for (std::size_t i = 0; i < count; ++i) {
    for (int neighbour = 0; neighbour < (lag == Vec<Dim>(0.0) ? 1 : 2); ++neighbour) {
      std::size_t rest = i;
      for (int axis = 0; axis < Dim; ++axis) {
        const double x =
            distance * (static_cast<double>(rest % side) - 0.3 * static_cast<double>(side) + 0.137);
        result.offset[static_cast<std::size_t>(axis)].push_back(
            static_cast<float>(x + neighbour * lag[axis]));
        rest /= side;
      }
    }
  }
  return result;
}

template <int Dim>
std::vector<float> evaluate(const VaryingGaborNoise<Dim>& noise, const Scattered<Dim>& scattered) {
  std::vector<float> values(scattered.size());
  noise.evaluate(scattered.points(), scattered.parameters(), {values, {}});
  return values;
}

template <int Dim>
VaryingGaborNoise<Dim> make(GaborWaves waves, double impulses = 24.0) {
  VaryingGaborOptions options;
  options.impulses = impulses;
  options.waves = waves;
  options.frequency = 1.0;
  options.seed = 3;
  return VaryingGaborNoise<Dim>(options);
}

// The parameters change smoothly over several octaves from one end of the points to the other.
template <int Dim>
void set_smooth_fields(Scattered<Dim>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count);
    points.frequency.push_back(static_cast<float>(std::exp2(4.0 * t)));
    points.bandwidth.push_back(static_cast<float>(1.0 + 0.6 * std::sin(20.0 * t)));
    points.magnitude.push_back(static_cast<float>(2.0 + std::sin(9.0 * t)));
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      points.direction[axis].push_back(static_cast<float>(std::cos(7.0 * t + static_cast<double>(axis))));
    }
  }
}

template <int Dim>
void expect_unit_variance_under_varying_parameters(std::size_t count) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    SCOPED_TRACE(testing::Message() << Dim << "D, waves " << static_cast<int>(waves));
    const auto noise = make<Dim>(waves);
    auto points = independent_points<Dim>(count, 2.1 * noise.radius(1.0, 0.4));
    set_smooth_fields<Dim>(points);
    std::vector<float> values = evaluate<Dim>(noise, points);
    for (std::size_t i = 0; i < count; ++i) values[i] /= points.magnitude[i];
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
    // Parts of the field: 16 along the way, over four octaves of frequency.
    for (std::size_t part = 0; part < 16; ++part) {
      const std::vector<float> some(values.begin() + static_cast<std::ptrdiff_t>(part * count / 16),
                                    values.begin() + static_cast<std::ptrdiff_t>((part + 1) * count / 16));
      expect_within_4_sigma(estimate_mean(some, [](double x) { return x * x; }), 1.0);
    }
  }
}

TEST(VaryingGaborStatistics, VarianceIsOneUnderAnyFieldOfParameters) {
  expect_unit_variance_under_varying_parameters<3>(48000);
  expect_unit_variance_under_varying_parameters<4>(16000);
}

// Values of the same law: all at one place in the range of a level, that of a kernel whose scale is as many
// times the cells' side.
template <int Dim>
std::vector<float> values_at(const VaryingGaborNoise<Dim>& noise, double scale, std::size_t count) {
  const double frequency = scale_in_radii(noise) * noise.radius(1.0, 1.0) / scale;
  auto points = independent_points<Dim>(count, 2.1 * noise.radius(frequency, 1.0));
  points.frequency.assign(count, static_cast<float>(frequency));
  return evaluate<Dim>(noise, points);
}

// Over the places in cells, that is: points of a lattice that cells are no multiples of. A Poisson process of
// as many impulses has 0.2 to 0.3.
void expect_gaussian_values(GaborWaves waves) {
  constexpr std::size_t kCount = 120000;
  const auto noise = make<3>(waves, 0.0);
  double mean = 0.0;
  double beyond_3 = 0.0;
  double beyond_4 = 0.0;
  for (const double scale : {1.09, 1.3, 1.54, 1.83}) {  // middles of quarters of an octave
    const std::vector<float> values = values_at<3>(noise, scale, kCount);
    const Estimate fourth = estimate_mean(values, [](double x) { return std::pow(x, 4); });
    EXPECT_NEAR(fourth.mean, 3.0, 0.07 + 4.0 * fourth.error) << scale;
    mean += 0.25 * (fourth.mean - 3.0);
    for (const float value : values) {
      beyond_3 += std::abs(value) > 3.0f ? 0.25 / kCount : 0.0;
      beyond_4 += std::abs(value) > 4.0f ? 0.25 / kCount : 0.0;
    }
  }
  // Standard errors of fourth powers are sqrt(96 / 120000) = 0.028, of the mean of four half of that; 4 of
  // them. Of shares of 480000 values beyond 3 and 4 standard deviations they are 0.03 and 0.18 of them.
  EXPECT_NEAR(mean, noise.varying_excess_kurtosis(), 0.056);
  EXPECT_NEAR(beyond_3 / std::erfc(3.0 / std::numbers::sqrt2), 1.0, 0.1 + 0.12);
  EXPECT_NEAR(beyond_4 / std::erfc(4.0 / std::numbers::sqrt2), 1.0, 0.4 + 0.72);
}

TEST(VaryingGaborStatistics, StrataLookGaussianAtEveryScale) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    expect_gaussian_values(waves);
    EXPECT_LT(std::abs(make<3>(waves, 0.0).varying_excess_kurtosis()), 0.02);
    EXPECT_LT(std::abs(make<4>(waves, 0.0).varying_excess_kurtosis()), 0.02);
  }
}

TEST(VaryingGaborStatistics, FadingKeepsTheKurtosisOfAPoissonProcess) {
  const VaryingGaborOptions options{
      .frequency = 1.0, .impulses = 24.0, .impulses_process = ImpulseSpread::poisson, .seed = 3};
  const VaryingGaborNoise<3> noise(options);
  const GaborNoise<3> stationary(
      {.frequency = 1.0, .impulses = 24.0, .impulses_process = ImpulseSpread::poisson});
  EXPECT_NEAR(noise.varying_excess_kurtosis(), stationary.excess_kurtosis(), 1e-9);
  for (const double frequency : {0.8, 1.0, 1.3}) {
    auto points = independent_points<3>(60000, 2.1 * noise.radius(frequency, 1.0));
    points.frequency.assign(points.size(), static_cast<float>(frequency));
    expect_within_4_sigma(estimate_mean(evaluate<3>(noise, points), [](double x) { return std::pow(x, 4); }),
                          stationary.excess_kurtosis() + 3.0);
  }
}

TEST(VaryingGaborStatistics, ExcessKurtosisIsThatOfAStationaryNoiseOfAsManyImpulses) {
  const VaryingGaborNoise<3> noise({.frequency = 1.0, .impulses = 50.0});
  const GaborNoise<3> stationary({.frequency = 1.0, .impulses = 50.0});
  EXPECT_NEAR(noise.excess_kurtosis(), stationary.excess_kurtosis(),
              0.01);  // cubes' share of unlimited kernels
  EXPECT_NEAR(VaryingGaborNoise<3>({}).impulses_per_kernel(), GaborNoise<3>({}).impulses_per_kernel(), 1e-6);
}

// The covariance at a lag is that of a stationary noise: the Fourier transform of the spectrum. Where the
// parameters are constant, whichever the level.
template <int Dim>
void expect_covariance(double frequency) {
  const auto noise = make<Dim>(GaborWaves::isotropic);
  const GaborNoise<Dim> stationary(
      GaborNoiseOptions{.frequency = frequency, .impulses = noise.impulses_per_kernel()});
  const double radius = stationary.radius();
  for (const double lag : {0.2, 0.45, 0.8}) {
    // Of the compact kernel: the integral of its squared spectrum times the mean cosine.
    const auto density = [&](double f) {
      Vec<Dim> at(0.0);
      at[0] = f;
      return stationary.power_spectrum(at) * std::pow(f, Dim - 1) * unit_sphere_area(Dim);
    };
    const double expected =
        integrate([&](double f) { return density(f) * mean_cosine(Dim, 2.0 * kPi * f * lag / frequency); },
                  0.0, 8.0 * frequency, 40);
    Vec<Dim> along(0.0);
    along[Dim - 1] = lag / frequency;
    auto points = independent_points<Dim>(20000, 2.1 * radius + lag / frequency, along);
    points.frequency.assign(points.size(), static_cast<float>(frequency));
    const std::vector<float> values = evaluate<Dim>(noise, points);
    std::vector<double> products;
    for (std::size_t i = 0; i < values.size(); i += 2) {
      products.push_back(static_cast<double>(values[i]) * static_cast<double>(values[i + 1]));
    }
    expect_within_4_sigma(estimate_mean(products, [](double x) { return x; }), expected);
  }
}

TEST(VaryingGaborStatistics, CovarianceIsThatOfTheStationaryNoiseAtEveryScale) {
  expect_covariance<3>(1.0);
  expect_covariance<3>(1.37);
  expect_covariance<3>(0.8);
}

}  // namespace
}  // namespace solidnoise::varying_gabor_statistics_test
