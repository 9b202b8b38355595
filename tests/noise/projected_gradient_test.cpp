#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "reference/projected_kensler_reference.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"
#include "support/independent_values.h"
#include "support/message_of.h"
#include "support/scattered.h"
#include "support/simd_targets.h"

namespace solidnoise::projected_gradient_test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<float> values_of(const ProjectedGradientNoise& noise, const Scattered<3>& scattered) {
  std::vector<float> values(scattered.size());
  noise.evaluate(scattered.surface(), {values, {}});
  return values;
}

// A noise whose lattice unit is 1 to the last bits.
ProjectedGradientNoise in_lattice_units(std::uint64_t seed = 5) {
  const ProjectedGradientNoise unscaled({.frequency = 1.0});
  return ProjectedGradientNoise({.frequency = unscaled.lattice_spacing(), .seed = seed});
}

TEST(ProjectedGradientNoise, AgreesWithTheReferenceForEveryInstructionSet) {
  const ProjectedGradientNoise noise = in_lattice_units();
  const Scattered<3> scattered = scattered_points<3>(60, 300.0);
  const reference::ProjectedKensler procedure{.seed = 5};
  std::vector<double> expected;
  for (std::size_t i = 0; i < scattered.size(); ++i) {
    const Vec<3> normal =
        glm::normalize(Vec<3>(scattered.normal[0][i], scattered.normal[1][i], scattered.normal[2][i]));
    const std::array<double, 3> point{scattered.offset[0][i], scattered.offset[1][i], scattered.offset[2][i]};
    expected.push_back(procedure(point, {normal[0], normal[1], normal[2]}) /
                       std::sqrt(noise.lattice_variance()));
  }
  for_each_simd_target([&](std::int64_t) {
    const std::vector<float> values = values_of(noise, scattered);
    // 60 terms of some ten roundings, and positions rounded to 2^-20 of a cell where slopes are up to 10
    // per cell.
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_NEAR(values[i], expected[i], 5e-5) << "point " << i;
  });
}

TEST(ProjectedGradientNoise, MeanVarianceIsTheClosedForm) {
  // In lattice units, for unit gradients: two thirds of the integral of the window's square times that of the
  // two-dimensional noise, .0761598.
  EXPECT_NEAR(ProjectedGradientNoise({}).lattice_variance(), 0.0377172, 5e-8);
}

// Points far apart, but in one repetition of the tables, with random normals, each at a random position in
// its cell; and their neighbours at `lag` on the plane, which follow them.
Scattered<3> independent_pairs(std::size_t count, double lag) {
  RandomStream random(3);
  Scattered<3> result;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = random_direction<3>(random);
    const auto d = random_direction<3>(random);
    const Vec<3> normal(n[0], n[1], n[2]);
    const Vec<3> step = lag * glm::normalize(glm::cross(normal, Vec<3>(d[0], d[1], d[2])));
    const std::size_t cell[] = {i % 40, i / 40 % 40, i / 1600};
    for (int point = 0; point < (lag == 0.0 ? 1 : 2); ++point) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double jitter = point == 0 ? random.next_unit() : 0.0;
        const double base = point == 0 ? 6.25 * static_cast<double>(cell[axis]) + jitter
                                       : static_cast<double>(result.offset[axis].back());
        result.offset[axis].push_back(
            static_cast<float>(base + point * step[static_cast<glm::length_t>(axis)]));
        result.normal[axis].push_back(n[axis]);
      }
    }
  }
  return result;
}

TEST(ProjectedGradientNoise, HasUnitVarianceOverPositionsAndNormals) {
  const std::vector<float> values = values_of(in_lattice_units(), independent_pairs(40000, 0.0));
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x; }), 0.0);
  expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
}

TEST(ProjectedGradientNoise, CovarianceOnPlanesIsTheTransformOfTheSpectrum) {
  const GradientKernel<2> kernel(GradientNoiseOptions::Kernel::kensler);
  for (const double lag : {0.4, 0.9}) {
    const double expected =
        2.0 * kPi / kernel.mean_variance() *
        integrate(
            [&](double f) { return kernel.power_spectrum(f) * f * mean_cosine(2, 2.0 * kPi * f * lag); }, 0.0,
            6.0, 60);
    const std::vector<float> values = values_of(in_lattice_units(), independent_pairs(30000, lag));
    std::vector<double> products;
    for (std::size_t i = 0; i < values.size(); i += 2) {
      products.push_back(static_cast<double>(values[i]) * static_cast<double>(values[i + 1]));
    }
    expect_within_4_sigma(estimate_mean(products, [](double x) { return x; }), expected);
  }
}

// Mean square over seeds and a plane z = height, of the noise before scaling. The places of one seed are in
// one repetition of its tables.
Estimate mean_square_on_plane(double height) {
  std::vector<float> squares;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const ProjectedGradientNoise noise = in_lattice_units(seed);
    RandomStream random(seed);
    Scattered<3> plane;
    for (int i = 0; i < 2500; ++i) {
      plane.offset[0].push_back(static_cast<float>(5.0 * (i % 50) + random.next_unit()));
      plane.offset[1].push_back(static_cast<float>(5.0 * (i / 50) + random.next_unit()));
      plane.offset[2].push_back(static_cast<float>(height));
      plane.normal[0].push_back(0.0f);
      plane.normal[1].push_back(0.0f);
      plane.normal[2].push_back(1.0f);
    }
    for (const float value : values_of(noise, plane)) {
      squares.push_back(static_cast<float>(value * value * static_cast<float>(noise.lattice_variance())));
    }
  }
  return estimate_mean(squares, [](double x) { return x; });
}

TEST(ProjectedGradientNoise, PowerOfAPlaneBetweenTheLayersIsThatOfTheWindow) {
  // The sum over layers of the squared window: 1 in a layer, and half-way 2 (1/2)^2. Times the variance in
  // the plane, 2/3 of the two-dimensional one.
  const double in_layer = 2.0 / 3.0 * 0.0761598;
  expect_within_4_sigma(mean_square_on_plane(0.0), in_layer);
  expect_within_4_sigma(mean_square_on_plane(0.5), 0.5 * in_layer);
}

TEST(ProjectedGradientNoise, APointDoesNotDependOnTheOthersOrTheirOrder) {
  const ProjectedGradientNoise noise({.frequency = 1.0, .seed = 5});
  const Scattered<3> scattered = scattered_points<3>(2000, 10.0);
  const std::vector<float> expected = values_of(noise, scattered);
  std::vector<std::size_t> numbers;
  for (std::size_t i = scattered.size(); i-- > 0;) {
    if (i % 5 == 1) numbers.push_back(i);
  }
  const std::vector<float> some = values_of(noise, scattered.picked(numbers));
  for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(some[i], expected[numbers[i]]) << numbers[i];
  EXPECT_EQ(values_of(noise, scattered.picked(std::vector<std::size_t>{7}))[0], expected[7]);
}

TEST(ProjectedGradientNoise, NormalsHaveNoSignAndTheNoiseNoSeams) {
  const ProjectedGradientNoise noise({.frequency = 1.0, .seed = 5});
  Scattered<3> scattered = scattered_points<3>(300, 10.0);
  const std::vector<float> expected = values_of(noise, scattered);
  for (auto& component : scattered.normal) {
    for (float& x : component) x *= -2.0f;
  }
  EXPECT_EQ(values_of(noise, scattered), expected);

  // Along a line, and with a normal that turns: a jump would stay as large with finer steps.
  const auto largest_step = [&](std::size_t count, bool turn) {
    Scattered<3> path = scattered_points<3>(1, 4.0).picked(std::vector<std::size_t>(count, 0));
    for (std::size_t i = 0; i < count; ++i) {
      const double t = 3.0 * static_cast<double>(i) / static_cast<double>(count);
      (turn ? path.normal[0][i] : path.offset[0][i]) = static_cast<float>(turn ? std::sin(t) : t);
    }
    const std::vector<float> values = values_of(noise, path);
    double largest = 0.0;
    for (std::size_t i = 1; i < count; ++i)
      largest = std::fmax(largest, std::abs(static_cast<double>(values[i] - values[i - 1])));
    return largest;
  };
  for (const bool turn : {false, true}) EXPECT_LT(largest_step(20000, turn), 0.2 * largest_step(2000, turn));
}

TEST(ProjectedGradientNoise, RefusesWhatIsNotAllowed) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { ProjectedGradientNoise noise({.frequency = -1.0}); }),
            "frequency is -1; it must be between 1e-12 and 1000000000000 (cycles per world unit)");
  Scattered<3> scattered = scattered_points<3>(3, 1.0);
  scattered.normal[0][1] = NAN;
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              values_of(ProjectedGradientNoise({}), scattered);
            }).substr(0, 20),
            "normal of point 1 is");
}

}  // namespace
}  // namespace solidnoise::projected_gradient_test
