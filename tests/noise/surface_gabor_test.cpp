#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "reference/varying_gabor_reference.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_strata.h"
#include "solidnoise/noise/point/scale_layout.h"
#include "support/message_of.h"
#include "support/scattered.h"
#include "support/simd_targets.h"

namespace solidnoise::surface_gabor_test {
namespace {

constexpr double kImpulses = 20.0;

SurfaceGaborOptions some_options(GaborWaves waves) {
  SurfaceGaborOptions options;
  options.frequency = 1.0;
  options.impulses = kImpulses;
  options.waves = waves;
  options.seed = 11;
  return options;
}

std::vector<float> values_of(const SurfaceGaborNoise& noise, const Scattered<3>& scattered) {
  std::vector<float> values(scattered.size());
  noise.evaluate(scattered.surface(), scattered.parameters(), {values, {}});
  return values;
}

// Parameters that leave the kernel's radius alone.
Scattered<3> without_varying_radius(Scattered<3> scattered) {
  scattered.frequency.clear();
  scattered.bandwidth.clear();
  return scattered;
}

template <typename Check>
void for_each_kind(const Check& check) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    SCOPED_TRACE(testing::Message() << "waves " << static_cast<int>(waves));
    check(waves);
  }
}

double reference_value(const reference::VaryingGaborProcedure<3>& procedure, const KernelFamily& family,
                       const Scattered<3>& scattered, std::size_t i, double frequency, double bandwidth) {
  const KernelFamily::Member member = family.at(bandwidth);
  const CompactKernel compact = family.compact(member);
  reference::VaryingPoint<3> point;
  point.radius = member.cycles / frequency;
  point.energy = member.energy * point.radius * point.radius;
  const Vec<3> normal =
      glm::normalize(Vec<3>(scattered.normal[0][i], scattered.normal[1][i], scattered.normal[2][i]));
  Vec<3> wave(scattered.direction[0][i], scattered.direction[1][i], scattered.direction[2][i]);
  wave -= glm::dot(wave, normal) * normal;
  wave = glm::normalize(wave);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    point.position[a] = scattered.points().coordinate(i, axis);
    point.normal[a] = normal[axis];
  }
  point.kernel = [&](const reference::Position<3>& offset) {
    const Vec<3> along(offset[0], offset[1], offset[2]);
    const double r = glm::length(along) / point.radius;
    if (r >= 1.0) return 0.0;
    const bool oriented = family.waves() == GaborWaves::oriented;
    const double cosine = std::cos(2.0 * std::numbers::pi * frequency * glm::dot(along, wave));
    return compact.value(r) * (oriented ? cosine : 1.0);
  };
  return procedure(point);
}

// Of the kernel of the options in a layer of half the thickness layer * nominal.
StrataChoice strata_of(const SurfaceGaborOptions& options, double nominal) {
  const double a = gaussian_parameter(options.frequency, options.bandwidth);
  const double half = options.layer * nominal;
  return options.waves == GaborWaves::oriented
             ? layer_strata_choice(EvenGaborKernel<2>(a, options.frequency), half, layer_window)
             : layer_strata_choice(IsotropicGaborKernel<2>::with_unit_peak(options.frequency, a), half,
                                   layer_window);
}

// See varying_gabor_test.cpp; the distance along the surface loses another digit where the offset along the
// normal is nearly all of the distance.
constexpr double kRounding = 2e-4;

TEST(SurfaceGaborNoise, AgreesWithTheReferenceForEveryInstructionSet) {
  for_each_kind([](GaborWaves waves) {
    const Scattered<3> scattered = scattered_points<3>(80, 4.0);
    const KernelFamily family(2, waves, 1.0, 0.02);
    for (const double layer : {0.3, 1.0}) {
      SurfaceGaborOptions options = some_options(waves);
      options.layer = layer;
      const SurfaceGaborNoise noise(options);
      const double nominal = family.nominal_share() * noise.radius();
      const StrataChoice choice = strata_of(options, nominal);
      const double support = 2.0 * std::numbers::pi * layer * std::pow(nominal, 3);
      const Strata strata = choice.of_density(kImpulses / support);
      const ScaleLayout scales = scale_layout(choice, kImpulses / support, options.impulses_process);
      const reference::VaryingGaborProcedure<3> varying({.impulses = noise.impulses_per_kernel(),
                                                         .nominal = family.nominal_share(),
                                                         .scale = scales.scale / noise.radius(),
                                                         .count = scales.count,
                                                         .layer = layer,
                                                         .seed = 11});
      const reference::VaryingGaborProcedure<3> stationary(
          {.nominal = family.nominal_share(),
           .count = {static_cast<double>(strata.count), true, 0, strata.mirrored},
           .layer = layer,
           .side = strata.side,
           .seed = 11});
      std::vector<double> expected_varying, expected_stationary;
      for (std::size_t i = 0; i < scattered.size(); ++i) {
        const double magnitude = scattered.magnitude[i];
        expected_varying.push_back(magnitude * reference_value(varying, family, scattered, i,
                                                               scattered.frequency[i],
                                                               scattered.bandwidth[i]));
        expected_stationary.push_back(magnitude *
                                      reference_value(stationary, family, scattered, i, 1.0, 1.0));
      }
      for_each_simd_target([&](std::int64_t) {
        const auto expect_near = [](const std::vector<float>& values, const std::vector<double>& expected) {
          for (std::size_t i = 0; i < values.size(); ++i) {
            ASSERT_NEAR(values[i], expected[i], kRounding * std::fmax(1.0, std::abs(expected[i])))
                << "point " << i;
          }
        };
        expect_near(values_of(noise, scattered), expected_varying);
        expect_near(values_of(noise, without_varying_radius(scattered)), expected_stationary);
      });
    }
  });
}

TEST(SurfaceGaborNoise, APointDoesNotDependOnTheOthersTheirOrderOrTheThread) {
  for_each_kind([](GaborWaves waves) {
    const SurfaceGaborNoise noise(some_options(waves));
    const Scattered<3> all = scattered_points<3>(3000, 6.0);
    for (const Scattered<3>& scattered : {all, without_varying_radius(all)}) {
      const std::vector<float> expected = values_of(noise, scattered);
      std::vector<std::size_t> numbers;
      for (std::size_t i = scattered.size(); i-- > 0;) {
        if (i % 7 == 3) numbers.push_back(i);
      }
      std::vector<float> some;
      std::thread([&] { some = values_of(noise, scattered.picked(numbers)); }).join();
      for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(some[i], expected[numbers[i]]) << numbers[i];
      EXPECT_EQ(values_of(noise, scattered.picked(std::vector<std::size_t>{77}))[0], expected[77]);
    }
  });
}

// The points of a finely tessellated sphere and of a coarse one that has some points in common.
TEST(SurfaceGaborNoise, DoesNotDependOnTheTessellation) {
  const SurfaceGaborNoise noise(some_options(GaborWaves::isotropic));
  const auto sphere = [](int rows) {
    Scattered<3> points;
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column < 2 * rows; ++column) {
        const double latitude = std::numbers::pi * row / rows;
        const double longitude = std::numbers::pi * column / rows;
        const Vec<3> normal(std::sin(latitude) * std::cos(longitude),
                            std::sin(latitude) * std::sin(longitude), std::cos(latitude));
        for (int axis = 0; axis < 3; ++axis) {
          points.normal[static_cast<std::size_t>(axis)].push_back(static_cast<float>(normal[axis]));
          points.offset[static_cast<std::size_t>(axis)].push_back(static_cast<float>(3.0 * normal[axis]));
        }
      }
    }
    return points;
  };
  const std::vector<float> coarse = values_of(noise, sphere(8));
  const std::vector<float> fine = values_of(noise, sphere(64));
  for (std::size_t row = 0; row <= 8; ++row) {
    for (std::size_t column = 0; column < 16; ++column) {
      EXPECT_EQ(coarse[row * 16 + column], fine[row * 8 * 128 + column * 8]);
    }
  }
}

TEST(SurfaceGaborNoise, InstructionSetsWithFusedMultiplyAddGiveTheSameBits) {
  for_each_kind([](GaborWaves waves) {
    const SurfaceGaborNoise noise(some_options(waves));
    const Scattered<3> scattered = scattered_points<3>(500, 3.0);
    std::vector<std::vector<float>> results;
    for_each_simd_target([&](std::int64_t target) {
      if ((target & (HWY_AVX3_DL | HWY_AVX3 | HWY_AVX2)) != 0) results.push_back(values_of(noise, scattered));
    });
    for (const auto& result : results) EXPECT_EQ(result, results.front());
  });
}

TEST(SurfaceGaborNoise, IsTheSameFarFromTheOrigin) {
  for_each_kind([](GaborWaves waves) {
    const SurfaceGaborNoise noise(some_options(waves));
    Scattered<3> near = scattered_points<3>(300, 4.0);
    near.origin = Vec<3>(1e6, -1e6, 1e6 + 3.0);
    Scattered<3> far = near;
    far.origin[2] = 1e6;
    for (float& z : far.offset[2]) z += 3.0f;
    EXPECT_EQ(values_of(noise, near), values_of(noise, far));
    EXPECT_EQ(values_of(noise, without_varying_radius(near)), values_of(noise, without_varying_radius(far)));
  });
}

TEST(SurfaceGaborNoise, NormalsAndDirectionsHaveNoSignAndLengthsAboveOneSayNothing) {
  const SurfaceGaborNoise noise(some_options(GaborWaves::oriented));
  Scattered<3> scattered = scattered_points<3>(500, 4.0);
  const std::vector<float> expected = values_of(noise, scattered);
  for (std::size_t i = 0; i < scattered.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scattered.normal[axis][i] *= i % 2 == 0 ? -1.0f : 2.0f;
      scattered.direction[axis][i] *= i % 3 == 0 ? -4.0f : 1.0f;
    }
  }
  EXPECT_EQ(values_of(noise, scattered), expected);
}

TEST(SurfaceGaborNoise, ADirectionAlongTheNormalIsAllowed) {
  const SurfaceGaborNoise noise(some_options(GaborWaves::oriented));
  Scattered<3> scattered = without_varying_radius(scattered_points<3>(50, 4.0));
  scattered.direction = scattered.normal;
  for (const float value : values_of(noise, scattered)) EXPECT_TRUE(std::isfinite(value));
}

// The shorter a direction, the less it matters which it is.
TEST(SurfaceGaborNoise, NoDirectionIsAsGoodAsAnyShortOne) {
  const SurfaceGaborNoise noise(some_options(GaborWaves::oriented));
  Scattered<3> scattered = without_varying_radius(scattered_points<3>(200, 4.0));
  const auto largest_difference = [&](double length) {
    std::array<std::vector<float>, 2> values;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (auto& component : scattered.direction) component.assign(scattered.size(), 0.0f);
      scattered.direction[axis].assign(scattered.size(), static_cast<float>(length));
      values[axis] = values_of(noise, scattered);
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < scattered.size(); ++i)
      largest = std::max(largest, std::abs(static_cast<double>(values[0][i] - values[1][i])));
    return largest;
  };
  EXPECT_GT(largest_difference(1.0), 1.0);
  EXPECT_LT(largest_difference(0.03), 0.1);
  EXPECT_LT(largest_difference(0.0), 1e-3);
}

double largest_step(const std::vector<float>& values) {
  double largest = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    largest =
        std::fmax(largest, std::abs(static_cast<double>(values[i]) - static_cast<double>(values[i - 1])));
  }
  return largest;
}

TEST(SurfaceGaborNoise, IsContinuousInPositionNormalFrequencyBandwidthAndDirection) {
  const SurfaceGaborNoise noise(some_options(GaborWaves::oriented));
  const auto check = [&](const char* what, const auto& change) {
    SCOPED_TRACE(what);
    const auto largest_of = [&](std::size_t count) {
      Scattered<3> path = scattered_points<3>(1, 1.0).picked(std::vector<std::size_t>(count, 0));
      for (std::size_t i = 0; i < count; ++i) {
        change(path, i, static_cast<double>(i) / static_cast<double>(count));
      }
      return largest_step(values_of(noise, path));
    };
    const double fine = largest_of(20000);
    EXPECT_GT(fine, 0.0);
    EXPECT_LT(fine, 0.2 * largest_of(2000));  // a jump would stay as large
  };
  check("position",
        [](auto& path, std::size_t i, double t) { path.offset[0][i] = static_cast<float>(4.0 * t); });
  check("normal", [](auto& path, std::size_t i, double t) {
    path.normal[0][i] = static_cast<float>(std::cos(2.0 * t));
    path.normal[1][i] = static_cast<float>(std::sin(2.0 * t));
  });
  check("frequency", [](auto& path, std::size_t i, double t) {
    path.frequency[i] = static_cast<float>(std::exp2(5.0 * t - 2.0));
  });
  check("bandwidth", [](auto& path, std::size_t i, double t) {
    path.bandwidth[i] = static_cast<float>(0.1 * std::exp2(5.3 * t));
  });
  check("direction", [](auto& path, std::size_t i, double t) {
    path.normal[0][i] = path.normal[1][i] = 0.0f;
    path.normal[2][i] = 1.0f;
    path.direction[0][i] = static_cast<float>(std::cos(3.0 * t));
    path.direction[1][i] = static_cast<float>(std::sin(3.0 * t));
  });
}

TEST(SurfaceGaborNoise, NamesTheFirstPointThatIsNotAllowed) {
  const SurfaceGaborNoise noise({});
  const auto message = [&](const auto& spoil) {
    Scattered<3> scattered = scattered_points<3>(5, 1.0);
    spoil(scattered);
    return message_of<std::invalid_argument>([&] { values_of(noise, scattered); });
  };
  EXPECT_EQ(message([](auto& s) { s.normal[0][2] = s.normal[1][2] = s.normal[2][2] = 0.0f; }),
            "normal of point 2 is (0, 0, 0); it must have a length");
  EXPECT_EQ(message([](auto& s) { s.offset[1][4] = NAN; }),
            "position of point 4 is nan along axis 1; it must be finite");
  EXPECT_EQ(message([](auto& s) { s.normal[2].pop_back(); }), "there are 4 normals for 5 points");
  EXPECT_EQ(message([](auto& s) { s.frequency[1] = -2.0f; }),
            "frequency of point 1 is -2; it must be between 1e-12 and 1000000000000 (cycles per world unit)");
}

TEST(SurfaceGaborNoise, RefusesOptionsOutOfRange) {
  const auto message = [](const SurfaceGaborOptions& options) {
    return message_of<std::invalid_argument>([&] { SurfaceGaborNoise noise(options); });
  };
  EXPECT_EQ(message({.layer = 0.0}), "layer is 0; it must be between 0.1 and 1 (kernel radii)");
  EXPECT_EQ(message({.error = 0.9}), "error is 0.9; it must be between 0.0001 and 0.5 (relative RMS error)");
  EXPECT_EQ(message({.direction = Vec<3>(0.0)}), "direction is 0; it must have a length");
}

}  // namespace
}  // namespace solidnoise::surface_gabor_test
