#include "solidnoise/noise/point/scale_transition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace solidnoise {
namespace {

double smooth_step(double x) {
  return x * x * (3.0 - 2.0 * x);
}

// Integrals over [0, 1] of the second and fourth power of the smooth step.
constexpr double kStepSecond = 13.0 / 35.0;
constexpr double kStepFourth = 81.0 / 9.0 - 216.0 / 10.0 + 216.0 / 11.0 - 96.0 / 12.0 + 16.0 / 13.0;

}  // namespace

ScaleWeights scale_weights(ScaleTransition transition, int n, double alpha) {
  if (transition == ScaleTransition::fade) return {1.0, 1.0};
  const double growth = std::pow(1.0 + alpha, n);
  if (transition == ScaleTransition::paper) return {(1.0 - alpha) / growth, std::exp2(n) * alpha / growth};
  const double angle = 0.5 * std::numbers::pi * smooth_step(alpha);
  return {std::cos(angle) / std::sqrt(growth), std::sin(angle) * std::sqrt(std::exp2(n) / growth)};
}

double scale_variance(const ScaleWeights& weights, int n, double alpha) {
  const double growth = std::pow(1.0 + alpha, n);
  return weights.fine * weights.fine * growth + weights.coarse * weights.coarse * growth / std::exp2(n);
}

ScaleFade::ScaleFade(int n) : lowest(std::exp2(-n)), rise(0.5 * lowest) {
  const double constant = 1.0 - lowest - rise - fall;
  second_moment = constant + kStepSecond * (rise + fall);
  fourth_moment = constant + kStepFourth * (rise + fall);
  impulses_per_effective_one = fourth_moment / (second_moment * second_moment);
}

double ScaleFade::operator()(double y) const {
  return smooth_step(std::clamp(std::min((y - lowest) / rise, (1.0 - y) / fall), 0.0, 1.0));
}

}  // namespace solidnoise
