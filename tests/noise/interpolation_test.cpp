// Noise on lattices with fewer samples: weights, the budget of error, and that nothing but the error changes.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/noise/noise_recipe.h"
#include "solidnoise/noise/slice_noise.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"
#include "support/simd_targets.h"
#include "support/spectra.h"

namespace solidnoise {
namespace {

// That of a wave of eight samples under a Gaussian, at distances of samples.
AxisCovariance some_covariance(int count) {
  WaveMixture<1> mixture;
  mixture.waves.push_back({1.0, Vec<1>(0.7 / (2.0 * std::numbers::pi))});
  mixture.a = 0.05;
  return mixture.along(0, 1.0, count);
}

TEST(AxisWeights, OfSlopesAreTheBestOfEachPhase) {
  const auto along = some_covariance(33);
  for (const AxisStep shape : {AxisStep{2, 4}, AxisStep{3, 6}, AxisStep{4, 8}}) {
    const AxisWeights weights(shape, along, AxisWeights::Of::slopes);
    // The mean square error at a phase, with one weight changed, term by term.
    const auto error_at = [&](int phase, int tap, double change) {
      const auto weight = [&](int t) {
        return weights.of_phase(phase)[static_cast<std::size_t>(t)] + (t == tap ? change : 0.0);
      };
      double error = along.slope[0];
      for (int t = 0; t < shape.taps; ++t) {
        const int distance = phase - shape.step * (t - shape.taps / 2 + 1);
        const double to_slope = along.value_to_slope[static_cast<std::size_t>(std::abs(distance))];
        error -= 2.0 * weight(t) * (distance < 0 ? -to_slope : to_slope);
        for (int u = 0; u < shape.taps; ++u) {
          const auto apart = static_cast<std::size_t>(shape.step * std::abs(t - u));
          error += weight(t) * weight(u) * along.value[apart];
        }
      }
      return error;
    };
    double sum = 0.0;
    for (int phase = 0; phase < shape.step; ++phase) {
      const double error = error_at(phase, 0, 0.0);
      sum += error / shape.step;
      for (int tap = 0; tap < shape.taps; ++tap) {
        for (const double change : {-1e-3, 1e-3}) EXPECT_GT(error_at(phase, tap, change), error);
      }
    }
    const auto response = weights.response(along.value, along.value_to_slope);
    EXPECT_NEAR(along.slope[0] - 2.0 * response.product + response.square, sum, 1e-12);
  }
}

// The mean square error at one phase: E n^2 - 2 sum w E n n_t + sum sum w w E n_t n_u, term by term.
double squared_error_at(const AxisWeights& weights, int phase, const std::vector<double>& covariance,
                        double changed = 0.0) {
  const auto [step, taps] = weights.shape();
  const auto at = [&](int k) { return covariance[static_cast<std::size_t>(std::abs(k))]; };
  const auto weight = [&](int t) {
    return weights.of_phase(phase)[static_cast<std::size_t>(t)] + (t == 1 ? changed : 0.0);
  };
  double error = at(0);
  for (int t = 0; t < taps; ++t) {
    const int place = step * (t - taps / 2 + 1);
    error -= 2.0 * weight(t) * at(place - phase);
    for (int u = 0; u < taps; ++u) error += weight(t) * weight(u) * at(step * (t - u));
  }
  return error;
}

TEST(AxisWeights, AreTheBestOfEachPhase) {
  const auto along = some_covariance(33);
  const auto& covariance = along.value;
  for (const AxisStep shape : {AxisStep{2, 4}, AxisStep{3, 6}, AxisStep{4, 8}}) {
    const AxisWeights weights(shape, along);
    double sum = 0.0;
    for (int phase = 0; phase < shape.step; ++phase) {
      const double error = squared_error_at(weights, phase, covariance);
      sum += error / shape.step;
      if (phase == 0) {
        EXPECT_EQ(error, 0.0);
        continue;
      }
      for (const double change : {-1e-3, 1e-3}) {
        EXPECT_GT(squared_error_at(weights, phase, covariance, change), error);
      }
    }
    const auto response = weights.response(covariance, covariance);
    EXPECT_NEAR(covariance[0] - 2.0 * response.product + response.square, sum, 1e-12);
  }
}

TEST(AxisWeights, RespondToAWaveAsTheSumOverPhasesSays) {
  const AxisWeights weights({3, 6}, some_covariance(33));
  const double turn = 0.83;
  double mean = 0.0;
  double mean_square = 0.0;
  for (int phase = 0; phase < 3; ++phase) {
    double real = 0.0;
    double imaginary = 0.0;
    for (int t = 0; t < 6; ++t) {
      const double weight = weights.of_phase(phase)[static_cast<std::size_t>(t)];
      const double angle = turn * (3 * (t - 2) - phase);
      real += weight * std::cos(angle);
      imaginary += weight * std::sin(angle);
    }
    mean += real / 3.0;
    mean_square += (real * real + imaginary * imaginary) / 3.0;
  }
  std::vector<double> wave;
  for (int k = 0; k < 19; ++k) wave.push_back(std::cos(turn * k));
  const AxisWeights::Response response = weights.response(wave, wave);
  EXPECT_NEAR(response.product, mean, 1e-12);
  EXPECT_NEAR(response.square, mean_square, 1e-12);
}

// A lattice on which kernels reach `radius` samples.
template <int Dim>
LatticeFrame<Dim> frame_of(double support, double radius) {
  LatticeFrame<Dim> frame;
  for (int axis = 0; axis < Dim; ++axis) {
    frame.origin[axis] = 0.013 + axis;
    frame.step[axis] = support / radius;
  }
  return frame;
}

template <int Dim>
Lattice<Dim> lattice_of(const LatticeFrame<Dim>& frame, const Index<Dim>& first, int count) {
  return {frame.origin, frame.step, first, glm::vec<Dim, int>(count)};
}

// Kernels and interpolation together, against the noise of unlimited kernels, summed in double precision,
// relative to its standard deviation: the error that a recipe asks for is split between them. Little blocks,
// of all phases, far from each other.
template <template <int> class Noise, typename Options>
void expect_predicted_error(Options options, double samples_in_radius) {
  constexpr int kPlaces = 900;
  constexpr int kSide = 6;
  const ErrorBudget budget(options.error);
  const auto noise = std::make_shared<const Noise<3>>(with_truncation_share(options));
  const LatticeFrame<3> frame = frame_of<3>(support_of(*noise), samples_in_radius);
  const auto plan = InterpolationPlanner<3>(*noise, frame).plan(budget.interpolation).front();
  ASSERT_FALSE(plan.direct());
  const double predicted = std::sqrt(plan.error.truncation + plan.error.interpolation);
  EXPECT_LE(predicted, options.error);

  const auto interpolated = interpolate<3>(noise, frame, budget.interpolation);
  const auto kernel = kernel_reference(*noise);
  using Offset = reference::Position<3>;
  using Impulse = reference::Impulse<3>;
  std::vector<double> squares;
  const auto apart = static_cast<std::int64_t>(6.0 * samples_in_radius);
  for (int place = 0; place < kPlaces; ++place) {
    const Index<3> first(place % 30 * apart + place % 7, place / 30 * apart - place % 5, place % 11);
    const Lattice<3> lattice = lattice_of<3>(frame, first, kSide);
    const auto values = values_of<3>(*interpolated, lattice);
    for (std::size_t i = static_cast<std::size_t>(place) % 29; i < values.size(); i += 29) {
      const double unlimited = reference::sum_impulses<3>(
          impulses_near(*noise, sample_position(lattice, i), 2), Offset{},
          [&](const Offset& offset, const Impulse& impulse) { return kernel.unlimited(offset, impulse); });
      squares.push_back(std::pow(values[i] - noise->amplitude() * unlimited, 2));
    }
  }
  // Each place gives at least one independent error; with their excess kurtosis of a few the standard error
  // of the root mean square is at most 0.5 sqrt(2 + 1) / sqrt(900), under 3 %.
  const double measured = std::sqrt(estimate_mean(squares, [](double x) { return x; }).mean);
  EXPECT_NEAR(measured, predicted, 0.1 * predicted);
}

TEST(Interpolation, TotalErrorIsWithinATenthOfThePrediction) {
  for (const double error : {0.02, 0.05}) {
    for (const double radius : {16.0, 40.0}) {
      SCOPED_TRACE(testing::Message() << "error " << error << ", " << radius << " samples");
      expect_predicted_error<GaborNoise>(GaborNoiseOptions{.error = error, .impulses = 20.0, .seed = 3},
                                         radius);
      expect_predicted_error<OrientedGaborNoise>(
          OrientedGaborNoiseOptions{.error = error, .impulses = 20.0, .anisotropy = 0.5, .seed = 4}, radius);
    }
  }
}

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
    const auto check = [&](const Lattice<3>& part, const NoiseBlock<3>& block) {
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

// The gradient against that of the noise itself, whose kernels are so exact that what compact ones add to it,
// which coarse lattices smooth, is small beside the error; relative to the root mean square of its length.
// With samples of all phases over some 5000 kernels, and errors of neighbours alike, the measured root mean
// square is within a few per cent of the mean.
TEST(Interpolation, ErrorOfTheGradientIsWithinATenthOfThePrediction) {
  for (const double error : {0.01, 0.04}) {
    for (const double radius : {30.0, 60.0}) {
      SCOPED_TRACE(testing::Message() << "error " << error << ", " << radius << " samples");
      const auto check = [&](const auto& noise) {
        const LatticeFrame<3> frame = frame_of<3>(support_of(*noise), radius);
        const auto plan = InterpolationPlanner<3>(*noise, frame).plan(error, Quantity::gradient).front();
        ASSERT_FALSE(plan.direct());
        const Vec<3> power = noise->gradient_variance();
        const double mean_square = power.x + power.y + power.z;
        const double predicted = std::sqrt(plan.error.interpolation / mean_square);
        EXPECT_LE(predicted, error);
        const auto interpolated = interpolate<3>(std::shared_ptr<const Noise<3>>(noise), frame, error);
        double sum = 0.0;
        constexpr int kPlaces = 60;
        constexpr int kSide = 48;
        for (int place = 0; place < kPlaces; ++place) {
          const Index<3> first(place * 400, place % 7, -place % 11);
          const Lattice<3> lattice = lattice_of<3>(frame, first, kSide);
          const auto made = evaluate_in_one_block<3>(*interpolated, lattice);
          const auto expected = evaluate_in_one_block<3>(*noise, lattice);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < lattice.size(); ++i) {
              sum += std::pow(double(made.gradient[axis][i]) - double(expected.gradient[axis][i]), 2);
            }
          }
        }
        const double measured = std::sqrt(sum / (kPlaces * std::pow(kSide, 3.0)) / mean_square);
        EXPECT_NEAR(measured, predicted, 0.1 * predicted);
      };
      check(std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.error = 2e-4, .impulses = 12.0}));
      check(std::make_shared<const OrientedGaborNoise<3>>(
          OrientedGaborNoiseOptions{.error = 2e-4, .impulses = 12.0, .anisotropy = 0.5}));
    }
  }
}

// What shading and surfaces follow is the difference of neighbours, which is small where waves are long. For
// kernels that are all but unlimited: of others, the lattice is without their ripples of high frequency.
TEST(Interpolation, DifferencesOfNeighboursAreOfTheNoiseToo) {
  constexpr double kError = 0.01;
  for (const double radius : {16.0, 40.0, 115.0}) {
    const auto noise =
        std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.error = 0.001, .impulses = 20.0});
    const LatticeFrame<3> frame = frame_of<3>(support_of(*noise), radius);
    const auto interpolated = interpolate<3>(noise, frame, kError);
    constexpr int kSide = 150;
    const Lattice<3> lattice{frame.origin, frame.step, Index<3>(0), {kSide, kSide, 4}};
    const auto values = values_of<3>(*interpolated, lattice);
    const auto expected = values_of<3>(*noise, lattice);
    constexpr std::size_t kNext = 4 * kSide;  // the neighbour along the first axis
    double errors = 0.0;
    double differences = 0.0;
    for (std::size_t i = 0; i + kNext < values.size(); ++i) {
      const double difference = double(expected[i + kNext]) - double(expected[i]);
      differences += difference * difference;
      errors += std::pow(double(values[i + kNext]) - double(values[i]) - difference, 2);
    }
    EXPECT_GT(errors, 0.0);
    // The plan allows 5 times the error if those of neighbours knew nothing of each other; they are alike.
    EXPECT_LT(std::sqrt(errors / differences), 2.5 * kError) << radius;
  }
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

TEST(Interpolation, LowOctavesLeaveTheBudgetToTheHighOnes) {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0, .impulses = 32.0}, {}};
  recipe.fractal.octaves = 4;
  const auto noise = make_noise<3>(recipe);
  const double radius = GaborNoise<3>({.frequency = 1.0}).radius();
  const auto plans = InterpolationPlanner<3>(*noise, {Vec<3>(0.0), Vec<3>(radius / 128.0)}).plan(0.01);
  ASSERT_EQ(plans.size(), 4u);
  double total = 0.0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    total += plans[k].error.interpolation;
    if (k == 0) continue;
    EXPECT_LE(plans[k].axes[0].step, plans[k - 1].axes[0].step);
    EXPECT_GE(plans[k].error.interpolation, plans[k - 1].error.interpolation);
  }
  EXPECT_GE(plans.front().axes[0].step, 8);
  // No more than is allowed, for the sake of differences of neighbours here, and most of it.
  const Vec<3> neighbour(radius / 128.0, 0.0, 0.0);
  const double allowed = 1e-4 * 25.0 * (1.0 - covariance<3>(*noise, neighbour));
  EXPECT_LT(allowed, 1e-4);
  EXPECT_LE(total, allowed);
  EXPECT_GE(total, 0.25 * allowed);
}

TEST(Interpolation, WhatIsNotStationaryOrNotResolvedIsEvaluatedDirectly) {
  const std::shared_ptr<const Noise<3>> kensler = make_noise<3>({GradientNoiseOptions{.frequency = 1.0}, {}});
  EXPECT_EQ(interpolate<3>(kensler, {Vec<3>(0.0), Vec<3>(0.01)}, 0.01), kensler);
  const std::shared_ptr<const Noise<3>> gabor = make_noise<3>({GaborNoiseOptions{.frequency = 1.0}, {}});
  EXPECT_EQ(interpolate<3>(gabor, {Vec<3>(0.0), Vec<3>(0.3)}, 0.01), gabor);
}

TEST(ErrorBudget, PartsMakeTheWhole) {
  for (const double error : {1e-4, 0.001, 0.02, 0.5}) {
    const ErrorBudget budget(error);
    EXPECT_NEAR(std::hypot(budget.truncation, budget.interpolation), error, 1e-12);
  }
}

}  // namespace
}  // namespace solidnoise
