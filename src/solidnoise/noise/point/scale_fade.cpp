#include "solidnoise/noise/point/scale_fade.h"

#include <algorithm>
#include <cmath>

namespace solidnoise {
namespace {

double smooth_step(double x) {
  return x * x * (3.0 - 2.0 * x);
}

// Integrals over [0, 1] of the second and fourth power of the smooth step.
constexpr double kStepSecond = 13.0 / 35.0;
constexpr double kStepFourth = 81.0 / 9.0 - 216.0 / 10.0 + 216.0 / 11.0 - 96.0 / 12.0 + 16.0 / 13.0;

}  // namespace

ScaleFade::ScaleFade(int n) : dimensions(n), lowest(std::exp2(-n)), rise(0.5 * lowest) {
  const double constant = 1.0 - lowest - rise - fall;
  second_moment = constant + kStepSecond * (rise + fall);
  fourth_moment = constant + kStepFourth * (rise + fall);
  impulses_per_effective_one = fourth_moment / (second_moment * second_moment);
}

double ScaleFade::operator()(double y) const {
  return smooth_step(std::clamp(std::min((y - lowest) / rise, (1.0 - y) / fall), 0.0, 1.0));
}

}  // namespace solidnoise
