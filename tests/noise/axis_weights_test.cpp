// Weights of interpolation along an axis: each phase's are the best there are.
#include "solidnoise/noise/interpolation/axis_weights.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace solidnoise::axis_weights_test {
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

}  // namespace
}  // namespace solidnoise::axis_weights_test
