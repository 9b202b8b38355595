#include "solidnoise/noise/gabor/directions.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"

namespace solidnoise::directions_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDraws = 40000;

template <int Dim>
double edge_of(const DirectionCone<Dim>& cone) {
  const auto polar = cone.polar_angle(1.0);
  return std::atan2(polar.sine, polar.cosine);
}

// Runs a check in 2, 3 and 4 dimensions; in one there is one direction.
template <typename Check>
void for_each_sphere(const Check& check) {
  const auto run = [&]<int Dim>() {
    SCOPED_TRACE(testing::Message() << Dim << " dimensions");
    check.template operator()<Dim>();
  };
  run.template operator()<2>();
  run.template operator()<3>();
  run.template operator()<4>();
}

// Axes along each coordinate, both signs, and between them.
template <int Dim>
std::vector<Vec<Dim>> some_axes() {
  std::vector<Vec<Dim>> axes;
  for (int axis = 0; axis < Dim; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      axes.emplace_back(0.0);
      axes.back()[axis] = sign;
    }
  }
  axes.emplace_back(0.3);
  axes.emplace_back(0.0);
  for (int axis = 0; axis < Dim; ++axis) axes.back()[axis] = std::cos(2.0 + 3.0 * axis);
  return axes;
}

// The share of the sphere within an angle of an axis or of its opposite: the integral of sin^(n-2).
double double_cap(int n, double angle) {
  const auto ring = [n](double polar) { return std::pow(std::sin(polar), n - 2); };
  return integrate(ring, 0.0, angle, 4) / integrate(ring, 0.0, 0.5 * kPi, 4);
}

// The same in closed form.
template <int Dim>
double quick_double_cap(double angle) {
  if (Dim == 2) return 2.0 / kPi * angle;
  if (Dim == 3) return 2.0 * std::pow(std::sin(0.5 * angle), 2);
  return (2.0 * angle - std::sin(2.0 * angle)) / kPi;
}

template <int Dim>
std::vector<Vec<Dim>> draws(const DirectionCone<Dim>& cone, std::uint64_t key) {
  std::vector<Vec<Dim>> directions;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream stream(derive_seed(key, static_cast<std::uint64_t>(i)));
    directions.push_back(cone.draw(stream.next_unit(), stream));
  }
  return directions;
}

TEST(DirectionCone, OfTheWholeSphereIsUniform) {
  for_each_sphere([]<int Dim>() {
    std::uint64_t key = 0;
    for (const Vec<Dim>& axis : some_axes<Dim>()) {
      const auto directions = draws(DirectionCone<Dim>(axis, 0.0), ++key);
      // A uniform direction has E[x^2] = 1/n, E[x^4] = 3/(n(n+2)) and E[x^2 y^2] a third of that. 4 sigma.
      const double fourth = 3.0 / (Dim * (Dim + 2.0));
      const double on_diagonal = 4.0 * std::sqrt((fourth - 1.0 / (Dim * Dim)) / kDraws);
      const double off_diagonal = 4.0 * std::sqrt(fourth / 3.0 / kDraws);
      for (int a = 0; a < Dim; ++a) {
        for (int b = 0; b <= a; ++b) {
          double mean = 0.0;
          for (const auto& direction : directions) mean += direction[a] * direction[b] / kDraws;
          EXPECT_NEAR(mean, a == b ? 1.0 / Dim : 0.0, a == b ? on_diagonal : off_diagonal) << a << ' ' << b;
        }
      }
      // And along any direction its fourth power is right: E[x^8] = 105 / (n (n+2) (n+4) (n+6)).
      const double eighth = 105.0 / (Dim * (Dim + 2.0) * (Dim + 4.0) * (Dim + 6.0));
      for (const Vec<Dim>& along : some_axes<Dim>()) {
        double mean = 0.0;
        for (const auto& direction : directions) {
          mean += std::pow(glm::dot(direction, glm::normalize(along)), 4) / kDraws;
        }
        EXPECT_NEAR(mean, fourth, 4.0 * std::sqrt((eighth - fourth * fourth) / kDraws));
      }
    }
  });
}

TEST(DirectionCone, IsUniformWithinAnAngleAndEndsThere) {
  for_each_sphere([]<int Dim>() {
    std::uint64_t key = 100;
    for (const double anisotropy : {0.2, 0.5, 0.9, 0.999}) {
      for (const Vec<Dim>& axis : some_axes<Dim>()) {
        const DirectionCone<Dim> cone(axis, anisotropy);
        const double edge = edge_of(cone);
        EXPECT_NEAR(double_cap(Dim, edge), 1.0 - anisotropy, 1e-9);
        EXPECT_NEAR(quick_double_cap<Dim>(edge), 1.0 - anisotropy, 1e-9);
        // The share of the cone nearer to the axis is uniform: chi-square with 19 degrees of freedom, one
        // false alarm in 1e5.
        constexpr int kParts = 20;
        std::array<int, kParts> parts{};
        double narrowest = 1.0;
        for (const auto& direction : draws(cone, ++key)) {
          EXPECT_NEAR(glm::length(direction), 1.0, 1e-12);
          // From the sine: the cosine of a small angle loses digits.
          const double sine = glm::length(direction - glm::dot(direction, cone.axis()) * cone.axis());
          const double polar = std::asin(std::fmin(sine, 1.0));
          EXPECT_GT(glm::dot(direction, cone.axis()), -1e-9);
          EXPECT_LE(polar, edge + 1e-7);
          narrowest = std::fmin(narrowest, std::cos(polar));
          const double share = quick_double_cap<Dim>(polar) / (1.0 - anisotropy);
          ++parts[static_cast<std::size_t>(std::fmin(share * kParts, kParts - 1.0))];
        }
        EXPECT_LT(narrowest, std::cos(0.99 * edge));
        double chi_square = 0.0;
        for (const int count : parts) {
          chi_square += std::pow(count - kDraws / kParts, 2) / (kDraws / kParts);
        }
        EXPECT_GT(regularized_gamma_q(0.5 * (kParts - 1), 0.5 * chi_square), 1e-5);
      }
    }
  });
}

TEST(DirectionCone, HasNoPreferenceAroundItsAxis) {
  for_each_sphere([]<int Dim>() {
    std::uint64_t key = 200;
    for (const Vec<Dim>& axis : some_axes<Dim>()) {
      const DirectionCone<Dim> cone(axis, 0.5);
      const auto directions = draws(cone, ++key);
      for (int a = 0; a < Dim; ++a) {
        // The mean across the axis is 0, for each component of what is left without the part along it.
        double mean = 0.0;
        double square = 0.0;
        for (const auto& direction : directions) {
          const auto across = direction - glm::dot(direction, cone.axis()) * cone.axis();
          mean += across[a] / kDraws;
          square += across[a] * across[a] / kDraws;
        }
        EXPECT_NEAR(mean, 0.0, 4.0 * std::sqrt(square / kDraws) + 1e-12);
        // The second moments are the same along all axes perpendicular to the cone's: m (1 - axis_a^2).
        double perpendicular = 0.0;
        double spread = 0.0;
        for (const auto& direction : directions) {
          const auto across = direction - glm::dot(direction, cone.axis()) * cone.axis();
          const double excess = across[a] * across[a] - glm::dot(across, across) / (Dim - 1.0) *
                                                            (1.0 - cone.axis()[a] * cone.axis()[a]);
          perpendicular += excess / kDraws;
          spread += excess * excess / kDraws;
        }
        EXPECT_NEAR(perpendicular, 0.0, 4.0 * std::sqrt(spread / kDraws) + 1e-12);
      }
    }
  });
}

TEST(DirectionCone, OfFullAnisotropyIsItsAxis) {
  for_each_sphere([]<int Dim>() {
    for (const Vec<Dim>& axis : some_axes<Dim>()) {
      const DirectionCone<Dim> cone(7.0 * axis, 1.0);
      RandomStream stream(1);
      EXPECT_LT(glm::length(cone.draw(stream.next_unit(), stream) - glm::normalize(axis)), 1e-15);
      EXPECT_LT(glm::length(cone.at({1.0, 0.0}, {1.0, 0.0, 0.0}) - glm::normalize(axis)), 1e-12);
    }
  });
}

TEST(DirectionCone, StandsAroundAxesHoweverNearToTheFirstCoordinate) {
  for_each_sphere([]<int Dim>() {
    for (const double tilt : {0.0, 1e-15, 1e-12, 2e-12, 1e-9, 1e-4}) {
      Vec<Dim> axis(0.0);
      axis[0] = 1.0;
      axis[1] = tilt;
      const DirectionCone<Dim> cone(axis, 0.5);
      const Vec<Dim> tip = cone.at({1.0, 0.0}, {1.0, 0.0, 0.0});
      // A tilt below the square root of a double's precision may get lost; a float is not that precise.
      constexpr double kLost = 2e-8;
      EXPECT_LT(glm::length(tip - glm::normalize(axis)), kLost) << tilt;
      const Vec<Dim> beside = cone.at({std::cos(0.7), std::sin(0.7)}, {-1.0, 0.0, 0.0});
      EXPECT_NEAR(glm::length(beside), 1.0, 1e-12) << tilt;
      EXPECT_NEAR(glm::dot(beside, glm::normalize(axis)), std::cos(0.7), kLost) << tilt;
    }
  });
}

// The noise's own waves are drawn from the cone, with a phase of their own.
TEST(DirectionCone, IsWhatTheNoisesWavesAreDrawnFrom) {
  for_each_sphere([]<int Dim>() {
    for (const Vec<Dim>& axis : some_axes<Dim>()) {
      OrientedGaborNoiseOptions options;
      options.frequency = 5.0;
      options.anisotropy = 0.7;
      options.direction = Vec<4>(0.0);
      for (int a = 0; a < Dim; ++a) options.direction[a] = 3.0 * axis[a];
      const OrientedGaborNoise<Dim> noise(options);
      const double edge = edge_of(noise.directions());
      double cosine = 0.0;
      double sine = 0.0;
      constexpr int kWaves = 10000;
      for (int i = 0; i < kWaves; ++i) {
        const auto wave = noise.wave(mix_bits(static_cast<std::uint64_t>(i)));
        EXPECT_NEAR(glm::length(wave.frequency), 5.0, 1e-9);
        EXPECT_GT(glm::dot(wave.frequency, glm::normalize(axis)), 5.0 * std::cos(edge) - 1e-6);
        cosine += std::cos(2.0 * kPi * wave.phase);
        sine += std::sin(2.0 * kPi * wave.phase);
      }
      // Phases are uniform on the circle: 4 sigma of a sum of numbers of variance 1/2.
      EXPECT_NEAR(cosine, 0.0, 4.0 * std::sqrt(0.5 * kWaves));
      EXPECT_NEAR(sine, 0.0, 4.0 * std::sqrt(0.5 * kWaves));
    }
  });
}

}  // namespace
}  // namespace solidnoise::directions_test
