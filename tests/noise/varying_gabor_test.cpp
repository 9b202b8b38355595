#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "reference/varying_gabor_reference.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "support/gabor_noises.h"
#include "support/message_of.h"
#include "support/scattered.h"
#include "support/simd_targets.h"

namespace solidnoise::varying_gabor_test {
namespace {

constexpr double kImpulses = 20.0;

template <int Dim>
VaryingGaborOptions some_options(GaborWaves waves) {
  VaryingGaborOptions options;
  options.impulses = kImpulses;
  options.waves = waves;
  options.seed = 7;
  return options;
}

template <int Dim>
std::vector<float> values_of(const VaryingGaborNoise<Dim>& noise, const Scattered<Dim>& scattered) {
  std::vector<float> values(scattered.size());
  noise.evaluate(scattered.points(), scattered.parameters(), {values, {}});
  return values;
}

// Runs a check in 3 and 4 dimensions with both kinds of waves.
template <typename Check>
void for_each_kind(const Check& check) {
  const auto run = [&]<int Dim>() {
    for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
      SCOPED_TRACE(testing::Message() << Dim << "D, waves " << static_cast<int>(waves));
      check.template operator()<Dim>(waves);
    }
  };
  run.template operator()<3>();
  run.template operator()<4>();
}

// The value at one point, with the kernel of the family in double precision.
template <int Dim>
double reference_value(const reference::VaryingGaborProcedure<Dim>& procedure, const KernelFamily& family,
                       const Scattered<Dim>& scattered, std::size_t i, double frequency, double bandwidth) {
  const KernelFamily::Member member = family.at(bandwidth);
  const CompactKernel compact = family.compact(member);
  reference::VaryingPoint<Dim> point;
  point.radius = member.cycles / frequency;
  point.energy = member.energy * std::pow(point.radius, Dim);
  std::array<double, Dim> wave{};
  double length = 0.0;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    point.position[axis] = scattered.points().coordinate(i, static_cast<int>(axis));
    wave[axis] = scattered.direction[axis][i];
    length = std::hypot(length, wave[axis]);
  }
  point.kernel = [&](const reference::Position<Dim>& offset) {
    double square = 0.0;
    double along = 0.0;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      square += offset[axis] * offset[axis];
      along += offset[axis] * wave[axis] / length * frequency;
    }
    const double r = std::sqrt(square) / point.radius;
    if (r >= 1.0) return 0.0;
    const bool oriented = family.waves() == GaborWaves::oriented;
    return compact.value(r) * (oriented ? std::cos(2.0 * std::numbers::pi * along) : 1.0);
  };
  return procedure(point);
}

// In units of the standard deviation: 20 to 200 terms of a few roundings of 6e-8 each, times up to 3 that the
// largest kernel values are above it. Narrow bandwidths (here down to half an octave) have polynomials of
// degree 12 whose coefficients are some ten times the values.
constexpr double kRounding = 1e-4;

TEST(VaryingGaborNoise, AgreesWithTheReferenceForEveryInstructionSet) {
  for_each_kind([]<int Dim>(GaborWaves waves) {
    const Scattered<Dim> scattered = scattered_points<Dim>(60, 4.0);
    const VaryingGaborNoise<Dim> noise(some_options<Dim>(waves));
    const KernelFamily family(Dim, waves, 1.0, 0.02);
    const reference::VaryingGaborProcedure<Dim> procedure({.impulses = noise.impulses_per_kernel(),
                                                           .nominal = family.nominal_share(),
                                                           .scale = scale_in_radii(noise),
                                                           .count = scales_of(noise).count,
                                                           .seed = 7});
    std::vector<double> expected;
    for (std::size_t i = 0; i < scattered.size(); ++i) {
      const double value = reference_value<Dim>(procedure, family, scattered, i, scattered.frequency[i],
                                                scattered.bandwidth[i]);
      expected.push_back(value * scattered.magnitude[i]);
    }
    for_each_simd_target([&](std::int64_t) {
      const std::vector<float> values = values_of<Dim>(noise, scattered);
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_NEAR(values[i], expected[i], kRounding * std::fmax(1.0, std::abs(expected[i])))
            << "point " << i;
      }
    });
  });
}

TEST(VaryingGaborNoise, WithoutVaryingParametersAgreesWithTheReferenceOnOneGrid) {
  for_each_kind([]<int Dim>(GaborWaves waves) {
    Scattered<Dim> scattered = scattered_points<Dim>(60, 1.0);
    scattered.frequency.clear();
    scattered.bandwidth.clear();
    scattered.magnitude.clear();
    const VaryingGaborNoise<Dim> noise(some_options<Dim>(waves));
    const KernelFamily family(Dim, waves, 1.0, 0.02);
    const StrataChoice choice = strata_of<Dim>(noise.options());
    const Strata strata = choice.of_density(impulse_density(Dim, kImpulses, choice.radius));
    const reference::VaryingGaborProcedure<Dim> procedure(
        {.nominal = family.nominal_share(),
         .count = {static_cast<double>(strata.count), true, 0, strata.mirrored},
         .side = strata.side,
         .seed = 7});
    const std::vector<float> values = values_of<Dim>(noise, scattered);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double expected = reference_value<Dim>(procedure, family, scattered, i, 8.0, 1.0);
      ASSERT_NEAR(values[i], expected, kRounding * std::fmax(1.0, std::abs(expected))) << "point " << i;
    }
  });
}

TEST(VaryingGaborNoise, NarrowAndWideBandsAgreeWithTheReference) {
  for (const double bandwidth : {0.1, 0.3, 4.0}) {
    Scattered<3> scattered = scattered_points<3>(40, 8.0);
    scattered.bandwidth.assign(scattered.size(), static_cast<float>(bandwidth));
    const VaryingGaborNoise<3> noise(some_options<3>(GaborWaves::isotropic));
    const KernelFamily family(3, GaborWaves::isotropic, 1.0, 0.02);
    const reference::VaryingGaborProcedure<3> procedure({.impulses = noise.impulses_per_kernel(),
                                                         .nominal = family.nominal_share(),
                                                         .scale = scale_in_radii(noise),
                                                         .count = scales_of(noise).count,
                                                         .seed = 7});
    const std::vector<float> values = values_of<3>(noise, scattered);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double expected =
          scattered.magnitude[i] *
          reference_value<3>(procedure, family, scattered, i, scattered.frequency[i], scattered.bandwidth[i]);
      // The rounding that CompactKernel states for Clenshaw's rule, relative to the kernel's mean square,
      // where a few terms may be ten times that.
      ASSERT_NEAR(values[i], expected, 2e-3 * std::fmax(1.0, std::abs(expected)))
          << bandwidth << ", point " << i;
    }
  }
}

TEST(VaryingGaborNoise, APointDoesNotDependOnTheOthersTheirOrderOrTheThread) {
  for_each_kind([]<int Dim>(GaborWaves waves) {
    const VaryingGaborNoise<Dim> noise(some_options<Dim>(waves));
    const Scattered<Dim> scattered = scattered_points<Dim>(3000, 3.0);
    const std::vector<float> expected = values_of<Dim>(noise, scattered);
    // Every seventh point, backwards, by another thread.
    std::vector<std::size_t> numbers;
    for (std::size_t i = scattered.size(); i-- > 0;) {
      if (i % 7 == 3) numbers.push_back(i);
    }
    std::vector<float> some;
    std::thread([&] { some = values_of<Dim>(noise, scattered.picked(numbers)); }).join();
    for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(some[i], expected[numbers[i]]) << numbers[i];
    for (const std::size_t i : {std::size_t{0}, std::size_t{1234}}) {
      EXPECT_EQ(values_of<Dim>(noise, scattered.picked(std::vector<std::size_t>{i}))[0], expected[i]);
    }
  });
}

// Kernels of narrow bands reach over so many cells that impulses are far from most places to count from.
TEST(VaryingGaborNoise, APointOfNarrowBandsDoesNotDependOnTheOthersEither) {
  for_each_kind([]<int Dim>(GaborWaves waves) {
    VaryingGaborOptions options = some_options<Dim>(waves);
    options.bandwidth = 0.3;
    const VaryingGaborNoise<Dim> noise(options);
    Scattered<Dim> scattered = scattered_points<Dim>(600, 8.0);
    scattered.bandwidth.clear();
    const std::vector<float> expected = values_of<Dim>(noise, scattered);
    for (std::size_t i = 0; i < scattered.size(); i += 61) {
      EXPECT_EQ(values_of<Dim>(noise, scattered.picked(std::vector<std::size_t>{i}))[0], expected[i]) << i;
    }
  });
}

TEST(VaryingGaborNoise, MayBeSharedByThreadsFromTheFirstPointOn) {
  // Kernels are tabulated when they are first asked for: here by several threads at once.
  const Scattered<3> scattered = scattered_points<3>(2000, 3.0);
  const std::vector<float> expected =
      values_of<3>(VaryingGaborNoise<3>(some_options<3>(GaborWaves::isotropic)), scattered);
  const VaryingGaborNoise<3> shared(some_options<3>(GaborWaves::isotropic));
  std::vector<std::vector<float>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) {
    threads.emplace_back(
        [&, own = scattered] { result = values_of<3>(shared, own); });  // points() is for one thread
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, expected);
}

TEST(VaryingGaborNoise, InstructionSetsWithFusedMultiplyAddGiveTheSameBits) {
  for_each_kind([]<int Dim>(GaborWaves waves) {
    const VaryingGaborNoise<Dim> noise(some_options<Dim>(waves));
    const Scattered<Dim> scattered = scattered_points<Dim>(500, 2.0);
    std::vector<std::vector<float>> results;
    for_each_simd_target([&](std::int64_t target) {
      if ((target & (HWY_AVX3_DL | HWY_AVX3 | HWY_AVX2)) != 0)
        results.push_back(values_of<Dim>(noise, scattered));
    });
    for (const auto& result : results) EXPECT_EQ(result, results.front());
  });
}

TEST(VaryingGaborNoise, IsTheSameFarFromTheOrigin) {
  // The hierarchy's cells are powers of two, and a shift by a multiple of all of them only changes the random
  // numbers; so compare two ways to say the same far position.
  for_each_kind([]<int Dim>(GaborWaves waves) {
    const VaryingGaborNoise<Dim> noise(some_options<Dim>(waves));
    Scattered<Dim> near = scattered_points<Dim>(300, 2.0);
    near.origin = Vec<Dim>(-1048576.0 - 3.0);
    Scattered<Dim> far = near;
    far.origin = Vec<Dim>(-1048576.0);
    for (auto& offset : far.offset) {
      for (float& x : offset) x -= 3.0f;
    }
    EXPECT_EQ(values_of<Dim>(noise, near), values_of<Dim>(noise, far));
    for (const float value : values_of<Dim>(noise, far)) EXPECT_TRUE(std::isfinite(value));
  });
}

// Values along a path of parameters, at points of one position each.
template <int Dim>
Scattered<Dim> parameter_path(std::size_t count, double from, double to) {
  Scattered<Dim> path = scattered_points<Dim>(1, 1.0);
  path = path.picked(std::vector<std::size_t>(count, 0));
  path.magnitude.assign(count, 1.0f);
  path.bandwidth.assign(count, 1.0f);
  for (std::size_t i = 0; i < count; ++i) {
    path.frequency[i] = static_cast<float>(
        std::exp2(from + (to - from) * static_cast<double>(i) / static_cast<double>(count)));
  }
  return path;
}

double largest_step(const std::vector<float>& values) {
  double largest = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    largest = std::fmax(largest, std::abs(static_cast<double>(values[i]) - values[i - 1]));
  }
  return largest;
}

TEST(VaryingGaborNoise, IsContinuousInFrequencyAcrossTheLevels) {
  for_each_kind([]<int Dim>(GaborWaves waves) {
    const VaryingGaborNoise<Dim> noise(some_options<Dim>(waves));
    // Over six octaves. A jump would stay as large with steps ten times as fine.
    const double coarse = largest_step(values_of<Dim>(noise, parameter_path<Dim>(3000, -3.0, 3.0)));
    const double fine = largest_step(values_of<Dim>(noise, parameter_path<Dim>(30000, -3.0, 3.0)));
    EXPECT_LT(fine, 0.2 * coarse);
    EXPECT_LT(fine, 0.05);
  });
}

TEST(VaryingGaborNoise, IsContinuousInBandwidthDirectionAndPosition) {
  const auto check = [](const auto& change) {
    const VaryingGaborNoise<3> noise(some_options<3>(GaborWaves::oriented));
    const auto steps = [&](std::size_t count) {
      Scattered<3> path = parameter_path<3>(count, 0.4, 0.4);
      for (std::size_t i = 0; i < count; ++i)
        change(path, i, static_cast<double>(i) / static_cast<double>(count));
      return largest_step(values_of<3>(noise, path));
    };
    const double fine = steps(20000);
    EXPECT_LT(fine, 0.2 * steps(2000));
    EXPECT_GT(fine, 0.0);
  };
  check([](Scattered<3>& path, std::size_t i, double t) {
    path.bandwidth[i] = static_cast<float>(0.1 * std::exp2(5.3 * t));
  });
  check([](Scattered<3>& path, std::size_t i, double t) {
    path.direction[0][i] = static_cast<float>(std::cos(3.0 * t));
    path.direction[1][i] = static_cast<float>(std::sin(3.0 * t));
    path.direction[2][i] = 0.0f;
  });
  check([](Scattered<3>& path, std::size_t i, double t) {
    path.offset[1][i] = static_cast<float>(3.0 * t - 1.5);
  });
}

TEST(VaryingGaborNoise, ADirectionAndItsOppositeAreTheSame) {
  const VaryingGaborNoise<3> noise(some_options<3>(GaborWaves::oriented));
  Scattered<3> scattered = scattered_points<3>(500, 2.0);
  const std::vector<float> expected = values_of<3>(noise, scattered);
  for (std::size_t i = 0; i < scattered.size(); i += 2) {
    for (auto& component : scattered.direction) component[i] *= -1.0f;
  }
  EXPECT_EQ(values_of<3>(noise, scattered), expected);
  for (auto& component : scattered.direction) {
    for (float& value : component) value *= 4.0f;
  }
  EXPECT_EQ(values_of<3>(noise, scattered), expected);
}

TEST(VaryingGaborNoise, NamesTheFirstPointThatIsNotAllowed) {
  const VaryingGaborNoise<3> noise({});
  const auto message = [&](const auto& spoil) {
    Scattered<3> scattered = scattered_points<3>(5, 1.0);
    spoil(scattered);
    return message_of<std::invalid_argument>([&] { values_of<3>(noise, scattered); });
  };
  EXPECT_EQ(message([](auto& s) { s.frequency[3] = 0.0f; }),
            "frequency of point 3 is 0; it must be between 1e-12 and 1000000000000 (cycles per world unit)");
  EXPECT_EQ(message([](auto& s) { s.bandwidth[1] = 5.0f; }),
            "bandwidth of point 1 is 5; it must be between 0.1 and 4 (octaves)");
  EXPECT_EQ(message([](auto& s) { s.magnitude[4] = -1.0f; }),
            "magnitude of point 4 is -1; it must be between 0 and 1000000000000 (standard deviation)");
  EXPECT_EQ(message([](auto& s) { s.direction[1][2] = NAN; }),
            "direction of point 2 is nan; it must be between -1000000000 and 1000000000");
  EXPECT_EQ(message([](auto& s) { s.offset[2][0] = INFINITY; }),
            "position of point 0 is inf along axis 2; it must be finite");
  EXPECT_EQ(message([](auto& s) { s.frequency.pop_back(); }), "there are 4 values of frequency for 5 points");
}

TEST(VaryingGaborNoise, RefusesPositionsTooFarForTheirFrequency) {
  const VaryingGaborNoise<3> noise({});
  Scattered<3> scattered = scattered_points<3>(3, 1.0);
  scattered.offset[1][2] = 1e20f;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { values_of<3>(noise, scattered); }).substr(0, 43),
            "position of point 2 has a coordinate of 1.0");
  scattered.offset[1][2] = 1.0f;
  scattered.frequency[2] = 1e12f;
  scattered.offset[0][2] = 1e9f;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { values_of<3>(noise, scattered); }).substr(0, 20),
            "position of point 2 ");
}

TEST(VaryingGaborNoise, RefusesOptionsOutOfRange) {
  const auto message = [](const VaryingGaborOptions& options) {
    return message_of<std::invalid_argument>([&] { VaryingGaborNoise<3> noise(options); });
  };
  EXPECT_EQ(message({.frequency = 0.0}),
            "frequency is 0; it must be between 1e-12 and 1000000000000 (cycles per world unit)");
  EXPECT_EQ(message({.bandwidth = 0.05}), "bandwidth is 0.05; it must be between 0.1 and 4 (octaves)");
}

TEST(VaryingGaborNoise, NoPointsAreNoValues) {
  const VaryingGaborNoise<3> noise({});
  noise.evaluate(Points<3>{}, {}, {});
}

}  // namespace
}  // namespace solidnoise::varying_gabor_test
