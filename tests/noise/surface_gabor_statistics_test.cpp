// Moments and spectra of Gabor noise on surfaces, against the closed forms.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "reference/oriented_spectrum.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "support/independent_values.h"
#include "support/scattered.h"

namespace solidnoise::surface_gabor_statistics_test {
namespace {

constexpr double kPi = std::numbers::pi;

SurfaceGaborNoise make(GaborWaves waves, double layer = 0.5, double bandwidth = 1.0) {
  SurfaceGaborOptions options;
  options.frequency = 1.0;
  options.bandwidth = bandwidth;
  options.impulses = 24.0;
  options.waves = waves;
  options.layer = layer;
  options.seed = 5;
  return SurfaceGaborNoise(options);
}

// Pairs of points `lag` apart, on planes of random normals, the lag at the angle `turn` in the plane from the
// direction of the waves; the pairs so far apart that no impulse is seen by two of them.
Scattered<3> independent_pairs(std::size_t count, double distance, double lag, double turn) {
  RandomStream random(9);
  Scattered<3> result;
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = random_direction<3>(random);
    const auto d = random_direction<3>(random);
    const Vec<3> normal(n[0], n[1], n[2]);
    const Vec<3> across = glm::normalize(glm::cross(normal, Vec<3>(d[0], d[1], d[2])));
    const Vec<3> along = glm::cross(across, normal);
    const Vec<3> step = lag * (std::cos(turn) * along + std::sin(turn) * across);
    const Vec<3> first =
        distance * Vec<3>(static_cast<double>(i % side) + 0.21, static_cast<double>(i / side % side) - 7.4,
                          static_cast<double>(i / side / side) - 3.33);
    for (int point = 0; point < (lag == 0.0 ? 1 : 2); ++point) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        result.offset[a].push_back(static_cast<float>(first[axis] + point * step[axis]));
        result.normal[a].push_back(static_cast<float>(normal[axis]));
        result.direction[a].push_back(static_cast<float>(along[axis]));
      }
    }
  }
  return result;
}

std::vector<float> evaluate(const SurfaceGaborNoise& noise, const Scattered<3>& points) {
  std::vector<float> values(points.size());
  noise.evaluate(points.surface(), points.parameters(), {values, {}});
  return values;
}

Estimate covariance_of_pairs(const std::vector<float>& values) {
  std::vector<double> products;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    products.push_back(static_cast<double>(values[i]) * static_cast<double>(values[i + 1]));
  }
  return estimate_mean(products, [](double x) { return x; });
}

TEST(SurfaceGaborStatistics, MomentsOfTheWindowAreItsIntegrals) {
  for (const int power : {2, 4}) {
    const double expected =
        integrate([power](double u) { return std::pow(layer_window(u), power); }, -1.0, 1.0, 2);
    EXPECT_NEAR(layer_window_moment(power), expected, 1e-14);  // polynomials of degree 16 at the most: exact
  }
}

TEST(SurfaceGaborStatistics, MomentsAreTheSameForAllNormals) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    for (const double layer : {0.2, 0.5, 1.0}) {
      const SurfaceGaborNoise noise = make(waves, layer);
      const auto points = independent_pairs(30000, 2.05 * std::hypot(1.0, layer) * noise.radius(), 0.0, 0.0);
      const std::vector<float> values = evaluate(noise, points);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), noise.variance());
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                            noise.excess_kurtosis() + 3.0);
      // By where the normal points: near an axis, near a diagonal of the cells, and between.
      std::array<std::vector<float>, 3> parts;
      for (std::size_t i = 0; i < values.size(); ++i) {
        double largest = 0.0;
        for (const auto& component : points.normal)
          largest = std::fmax(largest, std::abs(static_cast<double>(component[i])));
        parts[largest > 0.9 ? 0 : largest < 0.7 ? 1 : 2].push_back(values[i]);
      }
      for (const auto& part : parts)
        expect_within_4_sigma(estimate_mean(part, [](double x) { return x * x; }), 1.0);
    }
  }
}

// The squares of waves of fixed phase are a fifth of the fourth moment there.
TEST(SurfaceGaborStatistics, KurtosisOfWideBandsIsTheClosedForm) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    const SurfaceGaborNoise noise = make(waves, 0.5, 2.0);
    // Steps of 5.6 sides of strata, so that the points have all places in these.
    const auto points = independent_pairs(400000, 2.3 * std::hypot(1.0, 0.5) * noise.radius(), 0.0, 0.0);
    expect_within_4_sigma(estimate_mean(evaluate(noise, points), [](double x) { return x * x * x * x; }),
                          noise.excess_kurtosis() + 3.0);
  }
}

TEST(SurfaceGaborStatistics, VarianceIsOneUnderVaryingParameters) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    const SurfaceGaborNoise noise = make(waves);
    constexpr std::size_t kCount = 30000;
    // The widest kernels are those of half an octave, of some three cycles' radius.
    auto points = independent_pairs(kCount, 8.0, 0.0, 0.0);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double t = static_cast<double>(i) / kCount;
      points.frequency.push_back(static_cast<float>(std::exp2(4.0 * t)));
      points.bandwidth.push_back(static_cast<float>(1.0 + 0.5 * std::sin(30.0 * t)));
    }
    const std::vector<float> values = evaluate(noise, points);
    for (std::size_t part = 0; part < 8; ++part) {
      const std::vector<float> some(values.begin() + static_cast<std::ptrdiff_t>(part * kCount / 8),
                                    values.begin() + static_cast<std::ptrdiff_t>((part + 1) * kCount / 8));
      expect_within_4_sigma(estimate_mean(some, [](double x) { return x * x; }), 1.0);
    }
  }
}

// Of all coherences down to none.
TEST(SurfaceGaborStatistics, VarianceIsOneWhereDirectionsAreUnsure) {
  for (const bool varies : {false, true}) {
    const SurfaceGaborNoise noise = make(GaborWaves::oriented);
    constexpr std::size_t kCount = 30000;
    auto points = independent_pairs(kCount, 8.0, 0.0, 0.0);
    for (std::size_t i = 0; i < kCount; ++i) {
      const float t = static_cast<float>(i) / kCount;
      for (auto& component : points.direction) component[i] *= t;
      if (varies) points.frequency.push_back(std::exp2(2.0f * std::sin(90.0f * t)));
    }
    const std::vector<float> values = evaluate(noise, points);
    for (std::size_t part = 0; part < 8; ++part) {
      const std::vector<float> some(values.begin() + static_cast<std::ptrdiff_t>(part * kCount / 8),
                                    values.begin() + static_cast<std::ptrdiff_t>((part + 1) * kCount / 8));
      expect_within_4_sigma(estimate_mean(some, [](double x) { return x * x; }), 1.0);
    }
  }
}

TEST(SurfaceGaborStatistics, BandIsThatOfTwoDimensionalGaborNoise) {
  const SurfaceGaborNoise noise({.frequency = 3.0, .bandwidth = 1.2});
  const GaborNoise<2> plane({.frequency = 3.0, .bandwidth = 1.2});
  EXPECT_EQ(noise.band().lower, plane.band().lower);
  EXPECT_EQ(noise.band().upper, plane.band().upper);
}

// On planes of all orientations the covariance at a lag is that of two-dimensional Gabor noise, the cosine
// transform of its spectrum, along any direction in the plane.
TEST(SurfaceGaborStatistics, CovarianceOnPlanesIsThatOfTwoDimensionalGaborNoise) {
  const SurfaceGaborNoise noise = make(GaborWaves::isotropic);
  const GaborNoise<2> plane({.frequency = 1.0});
  for (const double lag : {0.25, 0.5, 0.9}) {
    const double expected =
        2.0 * kPi *
        integrate(
            [&](double f) {
              return plane.power_spectrum({f, 0.0}) * f * mean_cosine(2, 2.0 * kPi * f * lag);
            },
            0.0, 10.0, 40);
    for (const double turn : {0.0, kPi / 4.0, kPi / 2.0}) {
      const auto points = independent_pairs(20000, 2.3 * noise.radius() + lag, lag, turn);
      expect_within_4_sigma(covariance_of_pairs(evaluate(noise, points)), expected);
    }
  }
}

// Where the direction is unsure, of a length below 1, waves are longer in the same envelope.
TEST(SurfaceGaborStatistics, OrientedCovarianceFollowsTheDirection) {
  const SurfaceGaborNoise noise = make(GaborWaves::oriented, 0.5, 2.0);
  const double a = gaussian_parameter(1.0, 2.0);
  for (const auto& [lag, length] : {std::pair{0.3, 1.0}, {0.5, 1.0}, {0.3, 0.6}, {0.5, 0.25}}) {
    for (const double turn : {0.0, kPi / 3.0, kPi / 2.0}) {
      // Midpoint rule over the plane of frequencies; the spectrum is smooth and small beyond 6.
      double expected = 0.0;
      constexpr double kStep = 0.05;
      for (double x = -6.0 + kStep / 2; x < 6.0; x += kStep) {
        for (double y = -6.0 + kStep / 2; y < 6.0; y += kStep) {
          const double phase = 2.0 * kPi * lag * (x * std::cos(turn) + y * std::sin(turn));
          expected += reference::oriented_spectrum(length, a, {x, y}) * std::cos(phase) * kStep * kStep;
        }
      }
      auto points = independent_pairs(20000, 2.3 * noise.radius() + lag, lag, turn);
      for (auto& component : points.direction) {
        for (float& value : component) value *= static_cast<float>(length);
      }
      expect_within_4_sigma(covariance_of_pairs(evaluate(noise, points)), expected);
    }
  }
}

TEST(SurfaceGaborStatistics, VarianceOnACurvedSurfaceIsOneToo) {
  // A sphere of about two kernel radii: its mean square, over seeds.
  std::vector<double> mean_squares;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SurfaceGaborOptions options;
    options.frequency = 1.0;
    options.impulses = 24.0;
    options.seed = seed;
    RandomStream random(seed);
    Scattered<3> sphere;
    for (int i = 0; i < 100; ++i) {
      const auto normal = random_direction<3>(random);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sphere.normal[axis].push_back(normal[axis]);
        sphere.offset[axis].push_back(2.6f * normal[axis]);
      }
    }
    const std::vector<float> values = evaluate(SurfaceGaborNoise(options), sphere);
    mean_squares.push_back(estimate_mean(values, [](double x) { return x * x; }).mean);
  }
  expect_within_4_sigma(estimate_mean(mean_squares, [](double x) { return x; }), 1.0);
}

// The papers' impulses: the same variance, and the excess kurtosis that Campbell's theorem gives them.
TEST(SurfaceGaborStatistics, PoissonImpulsesHaveTheirOwnKurtosis) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    const SurfaceGaborNoise noise({.frequency = 1.0,
                                   .impulses = 12.0,
                                   .impulses_process = ImpulseSpread::poisson,
                                   .waves = waves,
                                   .seed = 5});
    const std::vector<float> values =
        evaluate(noise, independent_pairs(60000, 2.3 * noise.radius(), 0.0, 0.0));
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
    EXPECT_GT(noise.excess_kurtosis(), 0.2);
    expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x * x * x; }),
                          3.0 + noise.excess_kurtosis());
  }
}

TEST(SurfaceGaborStatistics, DefaultNumberOfImpulsesTakesTheExcessKurtosisAway) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    SurfaceGaborOptions options;
    options.waves = waves;
    const SurfaceGaborNoise noise(options);
    EXPECT_LT(std::abs(noise.excess_kurtosis()), 0.02);
    EXPECT_LE(noise.kurtosis_given_place(), 0.26);
    EXPECT_GT(noise.kurtosis_given_place(), 0.05);
    EXPECT_LT(std::abs(noise.varying_excess_kurtosis()), 0.02);
    EXPECT_LE(noise.varying_kurtosis_given_place(), 0.26);
    EXPECT_GT(noise.varying_kurtosis_given_place(), 0.02);
  }
}

}  // namespace
}  // namespace solidnoise::surface_gabor_statistics_test
