#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "support/independent_values.h"
#include "support/message_of.h"
#include "support/spectra.h"

namespace solidnoise::surface_spectrum_test {
namespace {

constexpr double kLayer = 0.5;

// Points with their normals and tangents, as noises take them.
struct Places {
  std::vector<Vec<3>> positions;
  std::array<std::vector<float>, 3> normal, tangent;

  void add(const Vec<3>& at, const Vec<3>& n, const Vec<3>& u) {
    positions.push_back(at);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      normal[a].push_back(static_cast<float>(n[axis]));
      tangent[a].push_back(static_cast<float>(u[axis]));
    }
  }
  std::vector<float> values(const SurfaceSpectrumNoise& noise) const {
    const SurfacePoints points{{positions}, {normal[0], normal[1], normal[2]}};
    std::vector<float> result(positions.size());
    noise.evaluate(points, {tangent[0], tangent[1], tangent[2]}, {result, {}});
    return result;
  }
};

// A place of its own for each number: 20 units apart, beyond what the kernels of some_spectrum() reach, each
// with another plane.
struct Plane {
  Vec<3> at, normal, along, across;

  explicit Plane(int i) {
    at = 20.0 * Vec<3>(i % 21, i / 21 % 23, i / (21 * 23)) + Vec<3>(0.3, 0.1, 0.7);
    const double turn = 2.4 * i;
    const double z = std::fmod(0.618 * i, 2.0) - 1.0;
    const double r = std::sqrt(1.0 - z * z);
    normal = {r * std::cos(turn), r * std::sin(turn), z};
    along = glm::normalize(glm::cross(normal, Vec<3>(std::sin(1.7 * i), 0.4, std::cos(0.9 * i))));
    across = glm::cross(normal, along);
  }
};

TEST(SurfaceSpectrumNoise, OnEveryPlaneHasTheCovarianceOfItsSpectrum) {
  constexpr int kPlanes = 12000;
  SpectrumNoiseOptions options = some_spectrum(2);
  // Without the component at frequency 0, whose spectrum a fixed phase leaves, and where components overlap.
  options.model.channels[0].bands[0].components.pop_back();
  options.frequency = options.model.principal_frequency();
  options.error = 0.005;
  const SurfaceSpectrumNoise noise(options, kLayer);
  const std::array<Vec<2>, 5> offsets{{{0.0, 0.0}, {0.3, 0.0}, {0.0, 0.4}, {0.35, -0.3}, {-0.5, 0.8}}};
  Places places;
  for (int i = 0; i < kPlanes; ++i) {
    const Plane plane(i);
    for (const Vec<2>& offset : offsets) {
      places.add(plane.at + offset.x * plane.along + offset.y * plane.across, plane.normal, plane.along);
    }
  }
  const std::vector<float> values = places.values(noise);
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    std::vector<double> products;
    for (std::size_t i = 0; i < kPlanes; ++i) {
      products.push_back(static_cast<double>(values[i * offsets.size()]) * values[i * offsets.size() + k]);
    }
    const Estimate product = estimate_mean(products, [](double x) { return x; });
    const double expected = noise.spectrum().covariance({offsets[k], 0.0});
    // 0.01: the overlap of a component's two Gaussians, exp(-2 pi |w|^2 / a^2), at most 0.02 of 0.35.
    EXPECT_NEAR(product.mean, expected, 4.0 * product.error + 0.01) << "offset " << k;
  }
}

TEST(SurfaceSpectrumNoise, HasUnitVarianceAlsoWithFrequencyZero) {
  const SurfaceSpectrumNoise noise(some_spectrum(2), kLayer);
  Places places;
  for (int i = 0; i < 20000; ++i) places.add(Plane(i).at, Plane(i).normal, Plane(i).along);
  const std::vector<float> values = places.values(noise);
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
  const Estimate fourth = estimate_mean(values, [](double x) { return x * x * x * x; });
  EXPECT_LT(fourth.mean - 4.0 * fourth.error, 3.0 + noise.excess_kurtosis());
  EXPECT_GT(fourth.mean + 4.0 * fourth.error, 3.0 + 0.5 * noise.excess_kurtosis());
}

// A field of directions without poles has no signs that agree everywhere; a normal may point to either side.
TEST(SurfaceSpectrumNoise, DoesNotSeeTheSignOfATangent) {
  const SurfaceSpectrumNoise noise(some_spectrum(2), kLayer);
  Places places, opposite;
  for (int i = 0; i < 300; ++i) {
    const Plane plane(i);
    places.add(0.01 * plane.at, plane.normal, plane.along);
    opposite.add(0.01 * plane.at, 3.0 * plane.normal, -2.0 * plane.along + 0.5 * plane.normal);
  }
  const std::vector<float> expected = places.values(noise);
  const std::vector<float> values = opposite.values(noise);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-4) << i;
}

TEST(SurfaceSpectrumNoise, AValueDoesNotDependOnTheOtherPoints) {
  const SurfaceSpectrumNoise noise(some_spectrum(2), kLayer);
  Places all;
  std::vector<float> alone;
  for (int i = 0; i < 700; ++i) {
    const Plane plane(i);
    all.add(0.05 * plane.at, plane.normal, plane.along);
    Places one;
    one.add(0.05 * plane.at, plane.normal, plane.along);
    alone.push_back(one.values(noise)[0]);
  }
  EXPECT_EQ(all.values(noise), alone);
}

TEST(SurfaceSpectrumNoise, RefusesWhatItCannotMake) {
  const auto message = [](auto change) {
    SpectrumNoiseOptions options = some_spectrum(2);
    change(options);
    return message_of<std::invalid_argument>([&] { SurfaceSpectrumNoise(options, kLayer); });
  };
  EXPECT_EQ(message([](auto& o) { o = some_spectrum(3); }),
            "the spectrum is of 3 dimensions; it must be of 2");
  EXPECT_EQ(message([](auto& o) { o.period = Vec<4>(50.0); }), "a noise on a surface has no period");
  EXPECT_THROW(SurfaceSpectrumNoise(some_spectrum(2), 2.0), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::surface_spectrum_test
