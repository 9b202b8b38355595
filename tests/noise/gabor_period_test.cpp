#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/message_of.h"

namespace solidnoise::gabor_period_test {
namespace {

// Expects the same bits any number of periods away, where a period is so many steps along every axis.
template <int Dim>
void expect_period(const Noise<Dim>& noise, const Vec<4>& period, int steps) {
  Lattice<Dim> lattice;
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.step[axis] = period[axis] / steps;
    lattice.first[axis] = -3;
    lattice.count[axis] = Dim == 4 ? 4 : 7;
  }
  const Evaluated<Dim> expected = evaluate_in_one_block(noise, lattice);
  for (int axis = 0; axis < Dim; ++axis) {
    for (const int periods : {-3, 1, 1000}) {
      Lattice<Dim> shifted = lattice;
      shifted.first[axis] += steps * periods;
      EXPECT_EQ(evaluate_in_one_block(noise, shifted), expected) << "axis " << axis << ", " << periods;
    }
    Lattice<Dim> elsewhere = lattice;
    elsewhere.first[axis] += steps / 2;
    EXPECT_NE(evaluate_in_one_block(noise, elsewhere), expected) << "axis " << axis;
  }
}

TEST(GaborPeriod, HoldsExactlyForEveryBandwidthErrorAndAxis) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.25, 1.0, 4.0}) {
      for (const double error : {0.005, 0.1}) {
        // In radii; none of them a whole number but the least that is allowed.
        const auto check = [&](const auto& noise) {
          const double support = support_of(noise);
          auto options = noise.options();
          options.period = support * Vec<4>(2.0, 2.71, 3.14, 7.3);
          expect_period<Dim>(std::decay_t<decltype(noise)>(options), options.period, 24);
          options.period = support * Vec<4>(11.9, 2.001, 2.999, 4.0);
          expect_period<Dim>(std::decay_t<decltype(noise)>(options), options.period, 7);
        };
        for_each_gabor_noise<Dim>(check, bandwidth, error);
      }
    }
  });
}

// Three octaves of each kind of noise, with a period.
std::vector<NoiseRecipe> octaves_of_each_kind(const Vec<4>& period) {
  std::vector<NoiseRecipe> recipes(3);
  recipes[0].noise = GaborNoiseOptions{.frequency = 1.0, .impulses = 20.0, .period = period};
  recipes[1].noise = OrientedGaborNoiseOptions{.frequency = 1.0, .impulses = 20.0, .period = period};
  recipes[2].noise = GradientNoiseOptions{.frequency = 1.0, .period = period};
  for (NoiseRecipe& recipe : recipes) recipe.fractal = {.octaves = 3, .lacunarity = 3.0};
  return recipes;
}

TEST(GaborPeriod, HoldsForOctavesAndFrames) {
  const Vec<4> period(4.7, 5.0, 6.1, 10.0);
  for (const NoiseRecipe& recipe : octaves_of_each_kind(period)) {
    SCOPED_TRACE(recipe.noise.index());
    for_each_dimension([&]<int Dim>() { expect_period<Dim>(*make_noise<Dim>(recipe), period, 24); });
    const std::shared_ptr<const Noise<4>> noise = make_noise<4>(recipe);
    expect_period<3>(*slice(noise, 0.3), period, 24);
  }
}

// Frames n / 24 and those whole loops away, computed in double precision.
TEST(GaborPeriod, HoldsInTimeForFramesOfAnyLoop) {
  for (const double loop : {10.0, 241.0 / 24.0, 31.0 / 3.0}) {
    for (const NoiseRecipe& recipe : octaves_of_each_kind(Vec<4>(0.0, 0.0, 0.0, loop))) {
      SCOPED_TRACE(testing::Message() << "kind " << recipe.noise.index() << ", loop " << loop);
      const std::shared_ptr<const Noise<4>> noise = make_noise<4>(recipe);
      const Lattice<3> lattice = some_lattice<3>(0.5);
      const auto frame = [&](double t) { return evaluate_in_one_block<3>(*slice(noise, t), lattice); };
      for (const int n : {0, 7, 19}) {
        const Evaluated<3> expected = frame(n / 24.0);
        for (const int loops : {-3, 1, 100}) EXPECT_EQ(frame(n / 24.0 + loops * loop), expected) << n;
        EXPECT_NE(frame(n / 24.0 + 0.4 * loop), expected);
      }
    }
  }
}

// A tile put beside itself: across the seam, values go on along the gradient as they do elsewhere.
TEST(GaborPeriod, TilesMeetWithoutASeamInValueOrGradient) {
  constexpr double kPeriod = 6.0;
  constexpr int kSide = 768;
  constexpr double kStep = kPeriod / kSide;
  for (const NoiseRecipe& recipe : octaves_of_each_kind(Vec<4>(kPeriod))) {
    SCOPED_TRACE(recipe.noise.index());
    const auto noise = make_noise<2>(recipe);
    Lattice<2> lattice;
    lattice.step = Vec<2>(kStep);
    lattice.count = glm::ivec2(kSide);
    const Evaluated<2> tile = evaluate_in_one_block<2>(*noise, lattice);
    // How far the trapezoid rule over the gradient misses the next value, at most, at a line across an axis.
    const auto miss_at = [&](int axis, int line) {
      double most = 0.0;
      const int next = (line + 1) % kSide;
      for (int i = 0; i < kSide; ++i) {
        const auto here = static_cast<std::size_t>(axis == 0 ? line * kSide + i : i * kSide + line);
        const auto there = static_cast<std::size_t>(axis == 0 ? next * kSide + i : i * kSide + next);
        const auto& slope = tile.gradient[static_cast<std::size_t>(axis)];
        const double step = 0.5 * kStep * (slope[here] + slope[there]);
        most = std::max(most, std::abs(tile.values[there] - tile.values[here] - step));
      }
      return most;
    };
    for (int axis = 0; axis < 2; ++axis) {
      double elsewhere = 0.0;
      for (int line = 0; line + 1 < kSide; ++line) elsewhere = std::max(elsewhere, miss_at(axis, line));
      EXPECT_LE(miss_at(axis, kSide - 1), elsewhere) << "axis " << axis;
      EXPECT_LT(elsewhere, 0.01);  // else a seam would not be seen
    }
  }
}

TEST(GaborPeriod, HoldsAtAnyPosition) {
  for_each_dimension([]<int Dim>() {
    const auto check = [](const auto& noise) {
      // A position and the same one period on are doubles that differ by a rounding of 1e-15. Both fall on
      // the same 2^-20 of a cell, but with a probability of about 1e-9.
      RandomStream random(8);
      for (int i = 0; i < 200; ++i) {
        Lattice<Dim> here;
        for (int axis = 0; axis < Dim; ++axis) here.origin[axis] = 20.0 * (random.next_unit() - 0.5);
        Lattice<Dim> there = here;
        const int axis = i % Dim;
        there.origin[axis] += noise.options().period[axis];
        EXPECT_EQ(evaluate_in_one_block<Dim>(noise, here), evaluate_in_one_block<Dim>(noise, there));
      }
    };
    for_each_gabor_noise<Dim>(check, 1.0, 0.02, Vec<4>(5.3, 4.9, 7.7, 6.1));
  });
}

TEST(GaborPeriod, AxesWithoutAPeriodDoNotRepeat) {
  const auto check = [](const auto& noise) {
    Lattice<2> lattice = some_lattice<2>(1.0);
    const Evaluated<2> expected = evaluate_in_one_block<2>(noise, lattice);
    lattice.origin[1] += 6.0;
    EXPECT_EQ(evaluate_in_one_block<2>(noise, lattice), expected);
    lattice.origin[0] += 6.0;
    EXPECT_NE(evaluate_in_one_block<2>(noise, lattice), expected);
  };
  for_each_gabor_noise<2>(check, 1.0, 0.02, Vec<4>(0.0, 6.0, 0.0, 0.0));
}

TEST(GaborPeriod, ALoopEndsAsItStarted) {
  // 100 frames of a loop of 4 seconds at 25 frames per second, of which the first would come again.
  constexpr double kFrame = 1.0 / 25.0;
  constexpr int kFrames = 100;
  const auto check = [&](const auto& noise) {
    const auto frame = [&](int i) {
      const std::shared_ptr<const Noise<4>> shared = std::make_shared<std::decay_t<decltype(noise)>>(noise);
      return evaluate_in_one_block<3>(*slice(shared, i * kFrame), some_lattice<3>(1.0));
    };
    const Evaluated<3> start = frame(0);
    EXPECT_EQ(frame(kFrames), start);
    EXPECT_EQ(frame(kFrames + 17), frame(17));
    EXPECT_NE(frame(1), start);
    EXPECT_NE(frame(kFrames / 2), start);
  };
  for_each_gabor_noise<4>(check, 1.0, 0.02, Vec<4>(0.0, 0.0, 0.0, kFrames * kFrame));
}

TEST(GaborPeriod, BelowTwoRadiiIsRefused) {
  GaborNoiseOptions options;
  options.frequency = 1.0;
  const double radius = GaborNoise<3>(options).radius();
  options.period = Vec<4>(0.0, 0.0, 2.0 * radius, 0.0);
  EXPECT_NO_THROW(GaborNoise<3>{options});
  options.period = Vec<4>(0.0, 2.5, 0.0, 0.0);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { GaborNoise<3>{options}; }),
            "period is 2.5 along y; it must be at least 2.9435 (twice the kernel's radius), or 0 for none");
  options.period = Vec<4>(0.0, 0.0, 0.0, 1.0);
  EXPECT_NO_THROW(GaborNoise<3>{options});  // has no time
  EXPECT_EQ(message_of<std::invalid_argument>([&] { GaborNoise<4>{options}; }),
            "period is 1 along t; it must be at least 3.07194 (twice the kernel's radius), or 0 for none");
  OrientedGaborNoiseOptions oriented;
  oriented.frequency = 1.0;
  oriented.period = Vec<4>(3.2, 0.0, 0.0, 0.0);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { OrientedGaborNoise<3>{oriented}; }),
            "period is 3.2 along x; it must be at least 3.27327 (twice the kernel's radius), or 0 for none");
}

}  // namespace
}  // namespace solidnoise::gabor_period_test
