// Noise on lattices with fewer samples: nothing but the error changes, whatever the block.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/independent_values.h"
#include "support/lattices.h"
#include "support/simd_targets.h"
#include "support/spectra.h"

namespace solidnoise::interpolation_test {
namespace {

// Makes an interpolated noise that has not kept any samples yet.
using MakeAnew = std::function<std::shared_ptr<const Noise<3>>()>;

// Runs a check with noises of several kinds on a lattice that they are interpolated on.
template <typename Check>
void for_each_interpolated(const Check& check) {
  const auto run = [&](const std::string& name, std::shared_ptr<const Noise<3>> noise, double step) {
    SCOPED_TRACE(name);
    const LatticeFrame<3> frame{{0.013, -7.0, 1000.0}, {step, 0.8 * step, step}};
    const MakeAnew anew = [&] { return interpolate<3>(noise, frame, 0.01); };
    ASSERT_NE(anew(), noise);
    check(anew, *noise, frame);
  };
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0, .impulses = 20.0}, {}};
  run("isotropic", make_noise<3>(recipe), 0.06);
  run("frame", slice(std::shared_ptr<const Noise<4>>(make_noise<4>(recipe)), 0.37), 0.05);
  recipe.fractal.octaves = 3;
  run("octaves", make_noise<3>(recipe), 0.03);
  run("one direction",
      make_noise<3>({OrientedGaborNoiseOptions{
                         .frequency = 1.0, .anisotropy = 1.0, .direction = Vec<4>(3.0, 1.0, 0.0, 0.0)},
                     {}}),
      0.05);
  const auto example = std::make_shared<const SpectrumNoise<3>>(some_spectrum(3));
  run("by example", example, 0.04 / example->band().upper);
}

TEST(Interpolation, ValuesDoNotDependOnTheBlock) {
  for_each_interpolated([](const MakeAnew& anew, const Noise<3>&, const LatticeFrame<3>& frame) {
    const Lattice<3> whole = lattice_of<3>(frame, Index<3>(-21, 5, -3), 37);
    const auto expected = evaluate_in_one_block<3>(*anew(), whole);
    const auto check = [&](const Lattice<3>& part, const FieldBlock<3>& block) {
      Evaluated<3> made(part.size());
      block.evaluate(part, made.samples());
      for (std::size_t i = 0; i < part.size(); ++i) {
        std::size_t rest = i;
        std::size_t index = 0;
        std::size_t stride = 1;
        for (int axis = 2; axis >= 0; --axis) {
          const auto count = static_cast<std::size_t>(part.count[axis]);
          index += stride * (rest % count + static_cast<std::size_t>(part.first[axis] - whole.first[axis]));
          stride *= static_cast<std::size_t>(whole.count[axis]);
          rest /= count;
        }
        ASSERT_EQ(made.values[i], expected.values[index]) << "sample " << i;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          ASSERT_EQ(made.gradient[axis][i], expected.gradient[axis][index]) << "sample " << i;
        }
      }
    };
    const auto shared = anew();
    const auto block = shared->block(whole.bounds());
    for (const Index<3> start : {Index<3>(0), Index<3>(1, 2, 3), Index<3>(17, 23, 20), Index<3>(3, 9, 29)}) {
      for (const int count : {1, 5, 8}) {
        Lattice<3> part = whole;
        part.first += start;
        part.count = glm::vec<3, int>(count);
        check(part, *block);
        check(part, *shared->block(part.bounds()));
        const auto alone = anew();
        check(part, *alone->block(part.bounds()));
      }
    }
    check(whole, *block);
    // A box too large to keep its coarse samples.
    Box<3> huge = whole.bounds();
    huge.lower -= 40.0;
    huge.upper += 40.0;
    Lattice<3> part = whole;
    part.count = glm::vec<3, int>(9);
    check(part, *shared->block(huge));
  });
}

TEST(Interpolation, InstructionSetsWithFusedMultiplyAddGiveTheSameBits) {
  for_each_interpolated([](const MakeAnew& anew, const Noise<3>&, const LatticeFrame<3>& frame) {
    const Lattice<3> lattice = lattice_of<3>(frame, Index<3>(-3, 1, -11), 19);
    std::vector<Evaluated<3>> results;
    for_each_simd_target([&](std::int64_t target) {
      if ((target & (HWY_AVX3_DL | HWY_AVX3 | HWY_AVX2)) == 0) return;
      results.push_back(evaluate_in_one_block<3>(*anew(), lattice));
    });
    for (const Evaluated<3>& result : results) EXPECT_EQ(result, results.front());
  });
}

TEST(Interpolation, ValuesDoNotDependOnWhetherTheGradientIsWanted) {
  for_each_interpolated([](const MakeAnew& anew, const Noise<3>&, const LatticeFrame<3>& frame) {
    const Lattice<3> lattice = lattice_of<3>(frame, Index<3>(-3, 1, -11), 9);
    EXPECT_EQ(evaluate_in_one_block(*anew(), lattice).values, values_of<3>(*anew(), lattice));
  });
}

// 11 voxels in a kernel's radius: values are interpolated, gradients are not.
TEST(Interpolation, LeavesANoiseAloneWhoseGradientIsWantedAndSummed) {
  const auto noise = std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.impulses = 20.0});
  const LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(noise->radius() / 11.0)};
  EXPECT_NE(interpolate<3>(noise, frame, 0.01), noise);
  EXPECT_EQ(interpolate<3>(noise, frame, 0.01, Quantity::gradient), noise);
}

TEST(Interpolation, ThreadsShareANoise) {
  for_each_interpolated([](const MakeAnew& anew, const Noise<3>&, const LatticeFrame<3>& frame) {
    const Lattice<3> lattice = lattice_of<3>(frame, Index<3>(-3, 1, -11), 19);
    const auto expected = values_of<3>(*anew(), lattice);
    const auto shared = anew();
    std::vector<std::vector<float>> results(4);
    std::vector<std::thread> threads;
    for (auto& result : results) {
      threads.emplace_back([&] { result = values_of<3>(*shared, lattice); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : results) EXPECT_EQ(result, expected);
  });
}

// More samples than are kept: a walk through far places, and back to the first.
TEST(Interpolation, ForgottenSamplesComeBack) {
  const NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0, .impulses = 2.0}, {}};
  const LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(0.06)};
  const auto noise = interpolate<3>(make_noise<3>(recipe), frame, 0.01);
  const auto at = [&](int place) {
    return values_of<3>(*noise, lattice_of<3>(frame, Index<3>(1000 * place, -7, 3), 3));
  };
  const auto expected = at(0);
  for (int place = 1; place < 600; ++place) EXPECT_NE(at(place), expected);
  EXPECT_EQ(at(0), expected);
}

// A period of 2 x 29 samples allows steps of 2, one of 29 none at all.
TEST(Interpolation, RepeatsWithTheNoise) {
  constexpr double kStep = 0.0625;
  GaborNoiseOptions options{.frequency = 1.0, .impulses = 20.0};
  options.period = {58 * kStep, 64 * kStep, 29 * 2 * kStep, 0.0};
  const std::shared_ptr<const Noise<3>> noise = make_noise<3>({options, {}});
  const LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(kStep, kStep, 2.0 * kStep), {58, 64, 29}};
  for (const auto quantity : {Quantity::values, Quantity::gradient}) {
    const auto plan = InterpolationPlanner<3>(*noise, frame).plan(0.01, quantity).front();
    if (quantity == Quantity::gradient) {
      EXPECT_TRUE(plan.direct());
      continue;
    }
    EXPECT_EQ(plan.axes[0].step, 2);
    EXPECT_EQ(64 % plan.axes[1].step, 0);
    EXPECT_EQ(plan.axes[2].step, 1);
  }
  const auto interpolated = interpolate<3>(noise, frame, 0.01);
  const auto values = values_of<3>(*interpolated, lattice_of<3>(frame, Index<3>(-3, 1, -11), 19));
  for (const Index<3> shift : {Index<3>(58, 0, 0), Index<3>(0, -64, 0), Index<3>(58, 64, 29)}) {
    EXPECT_EQ(values_of<3>(*interpolated, lattice_of<3>(frame, Index<3>(-3, 1, -11) + shift, 19)), values);
  }
}

TEST(Interpolation, OtherLatticesAreOfTheNoiseItself) {
  for_each_interpolated([](const MakeAnew& anew, const Noise<3>& itself, const LatticeFrame<3>& frame) {
    const auto noise = anew();
    Lattice<3> lattice = lattice_of<3>(frame, Index<3>(-3, 1, -11), 9);
    EXPECT_NE(values_of<3>(*noise, lattice), values_of<3>(itself, lattice));
    lattice.origin.x += 0.001;
    EXPECT_EQ(values_of<3>(*noise, lattice), values_of<3>(itself, lattice));
    lattice.origin = frame.origin;
    lattice.step *= 0.5;
    EXPECT_EQ(values_of<3>(*noise, lattice), values_of<3>(itself, lattice));
  });
}

// What is left out of the noise itself is no more than the budget, and what compact kernels have of
// frequencies beyond the band, twice at the most: once for what is lost, and once for where it is found
// instead.
TEST(Interpolation, IsTheNoiseButForTheError) {
  for_each_interpolated([](const MakeAnew& anew, const Noise<3>& itself, const LatticeFrame<3>& frame) {
    const auto noise = anew();
    const Lattice<3> lattice = lattice_of<3>(frame, Index<3>(-3, 1, -11), 60);
    const auto values = values_of<3>(*noise, lattice);
    const auto expected = values_of<3>(itself, lattice);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += std::pow(static_cast<double>(values[i]) - static_cast<double>(expected[i]), 2);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(values.size())), 0.01 + 0.02);
    EXPECT_GT(sum, 0.0);
  });
}

// Images: an octave and a noise by example, whole and in strips.
TEST(Interpolation, OfImagesDoesNotDependOnTheStrip) {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0, .error = 0.002, .impulses = 20.0}, {}};
  const auto example = std::make_shared<const SpectrumNoise<2>>(some_spectrum(2));
  for (const std::shared_ptr<const Noise<2>>& noise :
       {std::shared_ptr<const Noise<2>>(make_noise<2>(recipe)), std::shared_ptr<const Noise<2>>(example)}) {
    const double step = 0.04 / noise->band().upper;
    const auto interpolated = interpolate<2>(noise, {Vec<2>(0.3), Vec<2>(step)}, 0.01);
    ASSERT_NE(interpolated, noise);
    const Lattice<2> whole{Vec<2>(0.3), Vec<2>(step), {-5, 9}, {70, 90}};
    const auto values = values_of<2>(*interpolated, whole);
    for (int start = 0; start < 70; start += 14) {
      Lattice<2> strip = whole;
      strip.first.x += start;
      strip.count.x = 14;
      const auto part = evaluate_in_one_block(*interpolated, strip).values;
      for (std::size_t i = 0; i < part.size(); ++i) {
        ASSERT_EQ(part[i], values[static_cast<std::size_t>(start) * 90 + i]) << "sample " << i;
      }
    }
    const auto direct = values_of<2>(*noise, whole);
    double squares = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      squares += std::pow(static_cast<double>(values[i]) - static_cast<double>(direct[i]), 2);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(values.size())), 0.01 + 0.02);
  }
}

// Variance and fourth moment of samples of all phases, far from each other: within 4 standard errors.
TEST(Interpolation, KeepsTheStatistics) {
  const auto noise =
      std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.frequency = 1.0, .impulses = 20.0});
  LatticeFrame<3> frame{Vec<3>(0.0), Vec<3>(noise->radius() / 16.0)};
  const auto interpolated = interpolate<3>(noise, frame, 0.01);
  ASSERT_NE(interpolated, std::shared_ptr<const Noise<3>>(noise));
  std::vector<float> values;
  for (int i = 0; i < 12000; ++i) {
    // 35 samples apart, more than the width of a kernel and of the taps together.
    const Index<3> first(37 * (i % 23), 39 * (i / 23 % 23), 41 * (i / 529));
    values.push_back(values_of<3>(*interpolated, lattice_of<3>(frame, first, 1)).front());
  }
  // The error takes less than its square from the variance.
  const Estimate variance = estimate_mean(values, [](double x) { return x * x; });
  EXPECT_NEAR(variance.mean, 1.0, 4.0 * variance.error + 4e-4);
  const Estimate fourth = estimate_mean(values, [](double x) { return x * x * x * x; });
  EXPECT_NEAR(fourth.mean, 3.0 + noise->excess_kurtosis(), 4.0 * fourth.error + 0.003);
}

TEST(Interpolation, WhatIsNotStationaryOrNotResolvedIsEvaluatedDirectly) {
  const std::shared_ptr<const Noise<3>> kensler = make_noise<3>({GradientNoiseOptions{.frequency = 1.0}, {}});
  EXPECT_EQ(interpolate<3>(kensler, {Vec<3>(0.0), Vec<3>(0.01)}, 0.01), kensler);
  const std::shared_ptr<const Noise<3>> gabor = make_noise<3>({GaborNoiseOptions{.frequency = 1.0}, {}});
  EXPECT_EQ(interpolate<3>(gabor, {Vec<3>(0.0), Vec<3>(0.3)}, 0.01), gabor);
}

}  // namespace
}  // namespace solidnoise::interpolation_test
