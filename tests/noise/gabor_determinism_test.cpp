// The same bits for the same position, however it is asked for.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/simd_targets.h"
#include "support/spectra.h"

namespace solidnoise::gabor_determinism_test {
namespace {

// Runs a check with each Gabor noise, in Dim dimensions, with sums of octaves, and, in 3D, with frames.
template <int Dim, typename Check>
void for_each_noise(const Check& check) {
  for_each_gabor_noise<Dim>([&](const Noise<Dim>& noise) { check(noise); });
  NoiseRecipe recipe;
  recipe.fractal.octaves = 3;
  recipe.noise = OrientedGaborNoiseOptions{.frequency = 0.7};
  SCOPED_TRACE("octaves");
  check(*make_noise<Dim>(recipe));
  if constexpr (Dim == 2 || Dim == 3) {
    SCOPED_TRACE("spectrum");
    check(SpectrumNoise<Dim>(some_spectrum(Dim)));
    check(SpectrumNoise<Dim>(some_spectrum(Dim, true)));
  }
  if constexpr (Dim == 3) {
    recipe.noise = GaborNoiseOptions{.frequency = 0.7, .impulses = 20.0};
    SCOPED_TRACE("frame");
    check(*slice(std::shared_ptr<const Noise<4>>(make_noise<4>(recipe)), 0.37));
  }
}

// Samples of the part of a lattice that starts at `first`.
template <int Dim>
Evaluated<Dim> part_of(const Evaluated<Dim>& whole, const Lattice<Dim>& lattice, const Lattice<Dim>& part) {
  Evaluated<Dim> result(part.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    std::size_t rest = i;
    std::size_t index = 0;
    std::size_t stride = 1;
    for (int axis = Dim - 1; axis >= 0; --axis) {
      const std::size_t count = static_cast<std::size_t>(part.count[axis]);
      index += (rest % count + static_cast<std::size_t>(part.first[axis] - lattice.first[axis])) * stride;
      stride *= static_cast<std::size_t>(lattice.count[axis]);
      rest /= count;
    }
    result.values[i] = whole.values[index];
    for (std::size_t axis = 0; axis < Dim; ++axis) result.gradient[axis][i] = whole.gradient[axis][index];
  }
  return result;
}

// A lattice far from 0, and its positions in another order.
template <int Dim>
struct LatticeAndPoints {
  Lattice<Dim> lattice;
  std::vector<Vec<Dim>> positions;
  std::vector<std::size_t> sample;  // of each point, in the lattice
  Points<Dim> points;

  LatticeAndPoints() {
    lattice = some_lattice<Dim>(1.0);
    lattice.origin = Vec<Dim>(1000.0);
    lattice.step = Vec<Dim>(0x1p-2);
    const std::size_t count = lattice.size();
    for (std::size_t i = 0; i < count; ++i) {
      sample.push_back(i * 1009 % count);
      positions.push_back(sample_position(lattice, sample[i]));
    }
    points = {positions};
  }
  LatticeAndPoints(const LatticeAndPoints&) = delete;
  LatticeAndPoints& operator=(const LatticeAndPoints&) = delete;
};

template <int Dim>
Evaluated<Dim> evaluate_points(const Noise<Dim>& noise, const Points<Dim>& points) {
  Evaluated<Dim> result(points.size());
  noise.evaluate(points, result.samples());
  return result;
}

TEST(GaborDeterminism, PointsInAnyOrderAreTheLatticesBitsForEveryInstructionSet) {
  for_each_dimension([]<int Dim>() {
    const LatticeAndPoints<Dim> both;
    for_each_noise<Dim>([&](const Noise<Dim>& noise) {
      for_each_simd_target([&](std::int64_t) {
        const Evaluated<Dim> expected = evaluate_in_one_block(noise, both.lattice);
        const Evaluated<Dim> result = evaluate_points(noise, both.points);
        for (std::size_t i = 0; i < both.sample.size(); ++i) {
          ASSERT_EQ(result.values[i], expected.values[both.sample[i]]) << "point " << i;
          for (std::size_t axis = 0; axis < Dim; ++axis) {
            ASSERT_EQ(result.gradient[axis][i], expected.gradient[axis][both.sample[i]])
                << "point " << i << ", axis " << axis;
          }
        }
      });
    });
  });
}

TEST(GaborDeterminism, APointDoesNotDependOnTheOthersInItsBatch) {
  for_each_dimension([]<int Dim>() {
    const LatticeAndPoints<Dim> both;
    for_each_noise<Dim>([&](const Noise<Dim>& noise) {
      const Evaluated<Dim> expected = evaluate_points(noise, both.points);
      for (const std::size_t i : {std::size_t{0}, both.points.size() / 2, both.points.size() - 1}) {
        const Evaluated<Dim> result = evaluate_points(noise, Points<Dim>{{&both.positions[i], 1}});
        EXPECT_EQ(result.values[0], expected.values[i]);
        for (std::size_t axis = 0; axis < Dim; ++axis) {
          EXPECT_EQ(result.gradient[axis][0], expected.gradient[axis][i]);
        }
      }
    });
  });
}

TEST(GaborDeterminism, InstructionSetsWithFusedMultiplyAddGiveTheSameBits) {
  for_each_dimension([]<int Dim>() {
    const LatticeAndPoints<Dim> both;
    for_each_noise<Dim>([&](const Noise<Dim>& noise) {
      std::vector<Evaluated<Dim>> lattices;
      std::vector<Evaluated<Dim>> scattered;
      for_each_simd_target([&](std::int64_t target) {
        if ((target & (HWY_AVX3_DL | HWY_AVX3 | HWY_AVX2)) == 0) return;
        lattices.push_back(evaluate_in_one_block(noise, both.lattice));
        scattered.push_back(evaluate_points(noise, both.points));
      });
      for (const auto& result : lattices) EXPECT_EQ(result, lattices.front());
      for (const auto& result : scattered) EXPECT_EQ(result, scattered.front());
    });
  });
}

TEST(GaborDeterminism, ValuesDoNotDependOnWhetherTheGradientIsWanted) {
  for_each_dimension([]<int Dim>() {
    const LatticeAndPoints<Dim> both;
    for_each_noise<Dim>([&](const Noise<Dim>& noise) {
      std::vector<float> values(both.lattice.size());
      noise.block(both.lattice.bounds())->evaluate(both.lattice, Samples<Dim>{values, {}});
      EXPECT_EQ(values, evaluate_in_one_block(noise, both.lattice).values);
      noise.evaluate(both.points, Samples<Dim>{values, {}});
      EXPECT_EQ(values, evaluate_points(noise, both.points).values);
    });
  });
}

TEST(GaborDeterminism, ABoxCutInTwoIsTheWhole) {
  for_each_dimension([]<int Dim>() {
    // Fine, and with samples farther apart than kernels.
    for (const double spacing : {0.2, 3.3}) {
      for_each_noise<Dim>([&](const Noise<Dim>& noise) {
        Lattice<Dim> lattice = some_lattice<Dim>(5.0 * spacing);
        if (Dim == 4 && spacing > 1.0) lattice.count = glm::vec<Dim, int>(3);
        const Evaluated<Dim> whole = evaluate_in_one_block(noise, lattice);
        for (int axis = 0; axis < Dim; ++axis) {
          const int cut = lattice.count[axis] / 2 + 1;
          Lattice<Dim> lower = lattice;
          lower.count[axis] = cut;
          EXPECT_EQ(evaluate_in_one_block(noise, lower), part_of(whole, lattice, lower));
          Lattice<Dim> upper = lattice;
          upper.first[axis] += cut;
          upper.count[axis] -= cut;
          EXPECT_EQ(evaluate_in_one_block(noise, upper), part_of(whole, lattice, upper));
        }
      });
    }
  });
}

TEST(GaborDeterminism, ABlockOfAnyBoxGivesTheSameBits) {
  for_each_dimension([]<int Dim>() {
    for_each_noise<Dim>([&](const Noise<Dim>& noise) {
      const Lattice<Dim> lattice = some_lattice<Dim>(1.0);
      const Evaluated<Dim> expected = evaluate_in_one_block(noise, lattice);
      // A box a little larger, one of many cells, and one too large for its impulses to be made at once.
      for (const double margin : {0.77, Dim == 4 ? 2.0 : 9.0, 1e7}) {
        Box<Dim> box = lattice.bounds();
        box.lower -= margin;
        box.upper += 0.3 * margin;
        Evaluated<Dim> result(lattice.size());
        noise.block(box)->evaluate(lattice, result.samples());
        EXPECT_EQ(result, expected) << "margin " << margin;
      }
      // And as many blocks as Noise::evaluate wants.
      Evaluated<Dim> result(lattice.size());
      noise.evaluate(lattice, result.samples());
      EXPECT_EQ(result, expected);
    });
  });
}

// A block keeps where the last lattice's samples are.
TEST(GaborDeterminism, WhatABlockKeepsOfEarlierBricksDoesNotShow) {
  for_each_dimension([]<int Dim>() {
    for_each_gabor_noise<Dim>([](const auto& noise) {
      constexpr int kSide = 8;
      Lattice<Dim> brick;
      brick.step = Vec<Dim>(support_of(noise) / 11.3);
      for (int axis = 0; axis < std::min(Dim, 3); ++axis) brick.count[axis] = kSide;
      Lattice<Dim> all = brick;
      all.count[0] = 20 * kSide;
      if (Dim > 1) all.count[Dim - 1] = 2 * kSide;
      const auto block = noise.block(all.bounds());
      for (const bool gradient : {false, true}) {
        for (int k = 0; k < 40; ++k) {
          brick.first[0] = kSide * (k % 20);
          if (Dim > 1) brick.first[Dim - 1] = (Dim == 4 ? 1 : kSide) * (k / 20);
          Evaluated<Dim> result(brick.size());
          Evaluated<Dim> expected(brick.size());
          const auto wanted = [&](Evaluated<Dim>& to) {
            return gradient ? to.samples() : Samples<Dim>{to.values, {}};
          };
          block->evaluate(brick, wanted(result));
          noise.block(brick.bounds())->evaluate(brick, wanted(expected));
          ASSERT_EQ(result, expected) << "brick " << k << (gradient ? " with gradient" : "");
        }
      }
    });
  });
}

TEST(GaborDeterminism, ThreadsShareANoise) {
  for_each_noise<3>([](const Noise<3>& noise) {
    const Lattice<3> lattice = some_lattice<3>(1.0);
    const Evaluated<3> expected = evaluate_in_one_block(noise, lattice);
    std::vector<Evaluated<3>> results(8, Evaluated<3>(lattice.size()));
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < results.size(); ++i) {
      threads.emplace_back(
          [&, i] { noise.block(lattice.bounds())->evaluate(lattice, results[i].samples()); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : results) EXPECT_EQ(result, expected);
  });
}

}  // namespace
}  // namespace solidnoise::gabor_determinism_test
