// Gradients of the noises whose kernels belong to the evaluation points, against differences of their values
// with all but the position held fixed.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"
#include "support/expect_gradient.h"
#include "support/scattered.h"
#include "support/simd_targets.h"
#include "support/spectra.h"

namespace solidnoise::point_gradient_test {
namespace {

template <int Dim>
std::vector<Vec<Dim>> copied(const Points<Dim>& points) {
  return {points.positions.begin(), points.positions.end()};
}

template <int Dim>
Slopes<Dim> along_axes(const Scattered<Dim>& scattered) {
  Slopes<Dim> slopes;
  slopes.frequency.assign(scattered.frequency.begin(), scattered.frequency.end());
  slopes.magnitude.assign(scattered.magnitude.begin(), scattered.magnitude.end());
  for (int axis = 0; axis < Dim; ++axis) {
    Vec<Dim> unit(0.0);
    unit[axis] = 1.0;
    slopes.directions.emplace_back(scattered.size(), unit);
  }
  return slopes;
}

// Along two tangents and, where it is 0, the normal: values do change there, and the gradient leaves it out.
Slopes<3> along_surface(const Scattered<3>& scattered) {
  Slopes<3> slopes = along_axes(scattered);
  slopes.directions.assign(2, {});
  for (std::size_t i = 0; i < scattered.size(); ++i) {
    const Vec<3> normal =
        glm::normalize(Vec<3>(scattered.normal[0][i], scattered.normal[1][i], scattered.normal[2][i]));
    const Vec<3> tangent = unit_tangent({0.3, 0.5, 0.8}, normal);
    slopes.directions[0].push_back(tangent);
    slopes.directions[1].push_back(glm::cross(normal, tangent));
  }
  return slopes;
}

void set_constant(Slopes<3>& slopes, double frequency) {
  slopes.frequency.assign(slopes.frequency.size(), frequency);
  slopes.magnitude.assign(slopes.magnitude.size(), 1.0);
}

// Of a gradient along the surface, the part along the normal: roundings of the parts along each axis.
template <typename Evaluate>
void expect_tangential(const Scattered<3>& scattered, const Slopes<3>& slopes, const Evaluate& evaluate) {
  const std::size_t count = scattered.size();
  std::vector<float> values(count);
  std::array<std::vector<float>, 3> g{values, values, values};
  evaluate(scattered.points(), Samples<3>{values, {g[0], g[1], g[2]}});
  for (std::size_t i = 0; i < count; ++i) {
    const double across = g[0][i] * scattered.normal[0][i] + g[1][i] * scattered.normal[1][i] +
                          g[2][i] * scattered.normal[2][i];
    ASSERT_NEAR(across / (2.0 * std::numbers::pi * slopes.frequency[i]), 0.0, 1e-5) << "point " << i;
  }
}

template <typename Evaluate>
void expect_gradient_along_surface(const Scattered<3>& scattered, const Slopes<3>& slopes,
                                   const Evaluate& evaluate) {
  for_each_simd_target([&](std::int64_t) {
    expect_gradient<3>(copied(scattered.points()), slopes, evaluate);
    expect_tangential(scattered, slopes, evaluate);
  });
}

class PointGradient : public testing::TestWithParam<GaborWaves> {};
INSTANTIATE_TEST_SUITE_P(Kinds, PointGradient, testing::Values(GaborWaves::isotropic, GaborWaves::oriented));

template <int Dim>
void expect_of_varying_noise(GaborWaves waves) {
  const VaryingGaborNoise<Dim> noise({.impulses = 20.0, .waves = waves, .seed = 3});
  const Scattered<Dim> scattered = scattered_points<Dim>(60, 4.0);
  for_each_simd_target([&](std::int64_t) {
    expect_gradient<Dim>(copied(scattered.points()), along_axes(scattered),
                         [&](const Points<Dim>& points, const Samples<Dim>& samples) {
                           noise.evaluate(points, scattered.parameters(), samples);
                         });
  });
}

TEST_P(PointGradient, OfVaryingNoiseIsThatWithItsParametersHeldFixed) {
  expect_of_varying_noise<3>(GetParam());
  expect_of_varying_noise<4>(GetParam());
}

TEST_P(PointGradient, OfSurfaceNoiseIsAlongTheSurface) {
  const SurfaceGaborNoise noise({.frequency = 2.0, .impulses = 20.0, .waves = GetParam(), .seed = 3});
  const Scattered<3> scattered = scattered_points<3>(60, 4.0);
  Slopes<3> slopes = along_surface(scattered);
  const auto surface = [&](const Points<3>& points) {
    return SurfacePoints{points, scattered.surface().normal};
  };
  expect_gradient_along_surface(scattered, slopes, [&](const Points<3>& points, const Samples<3>& samples) {
    noise.evaluate(surface(points), scattered.parameters(), samples);
  });
  set_constant(slopes, noise.options().frequency);
  expect_gradient_along_surface(scattered, slopes, [&](const Points<3>& points, const Samples<3>& samples) {
    noise.evaluate(surface(points), {}, samples);
  });
}

TEST(PointGradients, OfNoiseByExampleIsAlongTheSurface) {
  const SurfaceSpectrumNoise noise(some_spectrum(2), 0.5);
  const Scattered<3> scattered = scattered_points<3>(60, 4.0);
  Slopes<3> slopes = along_surface(scattered);
  set_constant(slopes, noise.band().upper);
  expect_gradient_along_surface(scattered, slopes, [&](const Points<3>& points, const Samples<3>& samples) {
    noise.evaluate({points, scattered.surface().normal}, scattered.parameters().direction, samples);
  });
}

TEST(PointGradients, OfProjectedNoiseIsAlongTheSurface) {
  const ProjectedGradientNoise noise({.frequency = 2.0, .seed = 3});
  const Scattered<3> scattered = scattered_points<3>(60, 4.0);
  Slopes<3> slopes = along_surface(scattered);
  set_constant(slopes, noise.options().frequency);
  expect_gradient_along_surface(scattered, slopes, [&](const Points<3>& points, const Samples<3>& samples) {
    noise.evaluate({points, scattered.surface().normal}, samples);
  });
}

}  // namespace
}  // namespace solidnoise::point_gradient_test
