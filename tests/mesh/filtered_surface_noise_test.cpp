#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "reference/oriented_spectrum.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise::filtered_surface_noise_test {
namespace {

// Points of the plane z = 0.3, and what a noise is given there.
struct Plane {
  std::vector<Vec<3>> positions;
  std::array<std::vector<float>, 3> normal;
  std::vector<float> frequency;

  void add(double x, double y) {
    positions.emplace_back(x, y, 0.3);
    for (std::size_t axis = 0; axis < 3; ++axis) normal[axis].push_back(axis == 2 ? 1.0f : 0.0f);
  }
  std::vector<float> evaluate(const SurfaceSpectrumNoise& noise) const {
    std::vector<float> values(positions.size());
    const std::vector<float> one(positions.size(), 1.0f);
    const std::vector<float> none(positions.size(), 0.0f);
    noise.evaluate({{positions}, {normal[0], normal[1], normal[2]}}, {one, none, none}, {values, {}});
    return values;
  }
  std::vector<float> evaluate(const SurfaceGaborNoise& noise, std::optional<double> frequency_there) {
    std::vector<float> values(positions.size());
    VaryingParameters<3> parameters;
    if (frequency_there) frequency.assign(positions.size(), static_cast<float>(*frequency_there));
    parameters.frequency = frequency;
    noise.evaluate({{positions}, {normal[0], normal[1], normal[2]}}, parameters, {values, {}});
    return values;
  }
};

// The mean over a Gaussian of this deviation around each of some points.
template <typename Evaluate>
std::vector<double> convolved(const std::vector<Vec<2>>& places, double deviation, const Evaluate& evaluate) {
  constexpr int kHalf = 20;
  const double step = 4.0 * deviation / kHalf;
  std::vector<double> means;
  for (const Vec<2>& place : places) {
    Plane plane;
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -kHalf; i <= kHalf; ++i) {
      for (int j = -kHalf; j <= kHalf; ++j) {
        plane.add(place.x + i * step, place.y + j * step);
        weights.push_back(std::exp(-0.5 * (i * i + j * j) * step * step / (deviation * deviation)));
        sum += weights.back();
      }
    }
    const std::vector<float> values = evaluate(plane);
    double mean = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) mean += weights[k] / sum * values[k];
    means.push_back(mean);
  }
  return means;
}

std::vector<Vec<2>> some_places() {
  RandomStream random(3);
  std::vector<Vec<2>> places;
  for (int i = 0; i < 40; ++i) places.emplace_back(10.0 * random.next_unit(), 10.0 * random.next_unit());
  return places;
}

Plane at(const std::vector<Vec<2>>& places) {
  Plane plane;
  for (const Vec<2>& place : places) plane.add(place.x, place.y);
  return plane;
}

void expect_near(const std::vector<float>& values, const std::vector<double>& expected, double bound) {
  double error = 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    error += std::pow(values[i] - expected[i], 2) / static_cast<double>(values.size());
    power += std::pow(expected[i], 2) / static_cast<double>(values.size());
  }
  EXPECT_LT(std::sqrt(error), bound);
  EXPECT_GT(power, 0.1);  // there is something left
}

// The filtered noise is off by the errors of its own kernels and of those that the filter was applied to,
// each the options' of a standard deviation: the root mean square of their difference is at most the sum.
TEST(FilteredSurfaceNoise, IsTheNoiseConvolvedWithAGaussian) {
  const std::vector<Vec<2>> places = some_places();
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    for (const std::optional<double> frequency : {std::optional<double>(), std::optional<double>(4.0)}) {
      for (const double deviation : {0.02, 0.05}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(waves) << ' ' << deviation);
        SurfaceGaborOptions options{.frequency = 4.0, .error = 0.02, .waves = waves, .seed = 8};
        const SurfaceGaborNoise unfiltered(options);
        options.filter = deviation;
        const SurfaceGaborNoise filtered(options);
        expect_near(
            at(places).evaluate(filtered, frequency),
            convolved(places, deviation, [&](Plane& plane) { return plane.evaluate(unfiltered, frequency); }),
            2.0 * options.error);
      }
    }
  }
}

// Two bands, of waves along both axes and of waves about as long as their kernels.
SpectrumNoiseOptions by_example() {
  GaborSpectrum spectrum;
  spectrum.bands = {{1.5, {{{2.0, 1.0, 0.0}, 1.0}, {{0.5, 0.0, 0.0}, 0.6}}},
                    {3.0, {{{4.0, -5.0, 0.0}, 0.4}, {{0.0, 6.0, 0.0}, 0.3}}}};
  ExemplarModel model;
  model.channels = {spectrum};
  return {.model = model, .frequency = 4.0, .error = 0.02, .seed = 8};
}

TEST(FilteredSurfaceNoise, ByExampleIsTheNoiseConvolvedWithAGaussian) {
  const std::vector<Vec<2>> places = some_places();
  for (const double deviation : {0.02, 0.05}) {
    SCOPED_TRACE(deviation);
    SpectrumNoiseOptions options = by_example();
    const SurfaceSpectrumNoise unfiltered(options, 0.3);
    options.filter = deviation;
    expect_near(at(places).evaluate(SurfaceSpectrumNoise(options, 0.3)),
                convolved(places, deviation, [&](const Plane& plane) { return plane.evaluate(unfiltered); }),
                2.0 * options.error);
  }
}

// Of 20 000 places some two waves apart: the standard error is .010.
TEST(FilteredSurfaceNoise, ByExampleHasTheVarianceThatIsSaid) {
  SpectrumNoiseOptions options = by_example();
  options.filter = 0.05;
  const SurfaceSpectrumNoise noise(options, 0.3);
  EXPECT_LT(noise.variance(), 0.9);
  EXPECT_NEAR(noise.spectrum().variance(), noise.variance(), 1e-12);
  Plane plane;
  for (int i = 0; i < 20000; ++i) plane.add(1.37 * (i % 141), 1.53 * (i / 141));
  double power = 0.0;
  for (const float value : plane.evaluate(noise)) power += value * value / 20000.0;
  EXPECT_NEAR(power, noise.variance(), 4.0 * 0.010 * noise.variance());
  options.filter = 10.0;
  const SurfaceSpectrumNoise nothing(options, 0.3);
  EXPECT_EQ(nothing.variance(), 0.0);
  for (const float value : at(some_places()).evaluate(nothing)) EXPECT_EQ(value, 0.0f);
}

TEST(FilteredSurfaceNoise, HasTheVarianceThatTheFilterLeavesOfItsSpectrum) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    for (const double bandwidth : {0.5, 1.0, 2.0}) {
      const SurfaceGaborNoise filtered(
          {.frequency = 2.0, .bandwidth = bandwidth, .error = 0.01, .waves = waves, .filter = 0.06});
      const double a = gaussian_parameter(2.0, bandwidth);
      const auto isotropic = IsotropicGaborKernel<2>::with_unit_peak(2.0, a);
      const auto of_plane = [&](const auto& density) {
        return integrate(
            [&](double x) {
              return integrate([&](double y) { return density(Vec<2>(x, y)); }, -10.0, 10.0, 5);
            },
            -10.0, 10.0, 5);
      };
      const double left = of_plane([&](const Vec<2>& f) {
        const double response = std::exp(-2.0 * kPi * kPi * 0.06 * 0.06 * (f.x * f.x + f.y * f.y));
        return response * response *
               (waves == GaborWaves::oriented
                    ? reference::oriented_spectrum(2.0, a, f)
                    : std::pow(isotropic.spectrum(glm::length(f)), 2) / isotropic.energy());
      });
      // Compact kernels have an error of a hundredth in amplitude.
      EXPECT_NEAR(filtered.variance(), left, 0.02) << bandwidth;
    }
  }
}

TEST(FilteredSurfaceNoise, IsNothingWhereNothingIsLeft) {
  SurfaceGaborOptions options{.frequency = 4.0, .filter = 1.0};
  EXPECT_EQ(SurfaceGaborNoise(options).variance(), 0.0);
  Plane plane;
  plane.add(0.1, 0.2);
  EXPECT_EQ(plane.evaluate(SurfaceGaborNoise(options), std::nullopt).front(), 0.0f);
}

TEST(FilteredVaryingNoise, IsTheNoiseConvolvedWithAGaussian) {
  constexpr double kDeviation = 0.05;
  constexpr int kHalf = 8;
  constexpr double kStep = 4.0 * kDeviation / kHalf;
  VaryingGaborOptions options{.frequency = 3.0, .seed = 4};
  const VaryingGaborNoise<3> noise(options);
  options.filter = kDeviation;
  const VaryingGaborNoise<3> filtered(options);
  double error = 0.0;
  for (int place = 0; place < 40; ++place) {
    const Vec<3> centre(0.37 * place, 0.11 * place, 0.05 * place);
    std::vector<Vec<3>> positions{centre};
    std::vector<double> weights{0.0};
    for (int i = -kHalf; i <= kHalf; ++i) {
      for (int j = -kHalf; j <= kHalf; ++j) {
        for (int k = -kHalf; k <= kHalf; ++k) {
          const Vec<3> away = kStep * Vec<3>(i, j, k);
          positions.push_back(centre + away);
          weights.push_back(std::pow(kStep / kDeviation, 3) / std::pow(2.0 * kPi, 1.5) *
                            std::exp(-0.5 * glm::dot(away, away) / (kDeviation * kDeviation)));
        }
      }
    }
    const std::vector<float> frequency(positions.size(), 3.0f);
    VaryingParameters<3> parameters;
    parameters.frequency = frequency;
    std::vector<float> values(positions.size());
    noise.evaluate({positions}, parameters, {values, {}});
    double mean = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) mean += weights[k] * values[k];
    filtered.evaluate({positions}, parameters, {values, {}});
    error += std::pow(values.front() - mean, 2) / 40.0;
  }
  EXPECT_LT(std::sqrt(error), 2.0 * options.error);
}

}  // namespace
}  // namespace solidnoise::filtered_surface_noise_test
