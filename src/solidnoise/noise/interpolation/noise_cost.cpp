#include "solidnoise/noise/interpolation/noise_cost.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "solidnoise/noise/convolution/sparse_convolution.h"

namespace solidnoise {
namespace {

// Measured on the machine that Cost names, all threads busy. What the planner calls nanoseconds are those of
// a sum by itself, which compares ways to make it.
constexpr double kSumsInPractice = 2.0;
constexpr double kSecondsPerImpulseMade = 25e-9;
constexpr double kBytesPerImpulse = 56.0;
constexpr double kSecondsPerPointImpulse = 2e-9;
constexpr double kSecondsPerGradientSample = 6e-9;
constexpr double kNanosecond = 1e-9;

template <typename Visit>
void for_each_part(const Noise<3>& noise, const Visit& visit) {
  const std::vector<Noise<3>::Part> parts = noise.parts();
  for (std::size_t i = 0; i < parts.size(); ++i) visit(i, parts[i].noise->waves());
  if (parts.empty()) visit(0, noise.waves());
}

// Impulses per unit of volume.
double density_of(const WaveMixture<3>& waves) {
  constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;
  return waves.radius > 0.0 ? waves.impulses / (kBall * std::pow(waves.radius, 3)) : 0.0;
}

}  // namespace

Cost cost_on_lattice(const Noise<3>& noise, const LatticeFrame<3>& frame, const LatticeWork& work) {
  const std::vector<InterpolationPlan<3>> plans =
      InterpolationPlanner<3>(noise, frame).plan(work.error, work.quantity);
  Cost cost;
  for_each_part(noise, [&](std::size_t part, const WaveMixture<3>& waves) {
    double block = density_of(waves);
    for (int axis = 0; axis < 3; ++axis) block *= frame.step[axis] * work.side + 2.0 * waves.radius;
    const double blocks = work.samples / std::pow(work.side, 3);
    const double held = block > kMostImpulsesInBlock ? 0.0 : block;  // denser ones are made brick by brick
    const double sample = waves.impulses > 0.0 ? kSumsInPractice * plans[part].nanoseconds * kNanosecond
                                               : kSecondsPerGradientSample;
    cost += {work.samples * sample + blocks * block * kSecondsPerImpulseMade, held * kBytesPerImpulse};
  });
  return cost;
}

Cost cost_at_points(const Noise<3>& noise, double points) {
  Cost cost;
  for_each_part(noise, [&](std::size_t, const WaveMixture<3>& waves) {
    cost.seconds += points * (waves.impulses * kSecondsPerPointImpulse + kSecondsPerGradientSample);
    cost.bytes += waves.impulses * kBytesPerImpulse;
  });
  return cost;
}

Cost cost_at_points(const Noise<3>& noise, double points, const LatticeFrame<3>& frame, double error,
                    const PointSpread& spread) {
  Cost cost = cost_at_points(noise, points);
  cost.seconds = 0.0;
  for (const PointPlan& plan : plan_points(noise, frame, error, spread)) {
    cost.seconds += points * kSumsInPractice * plan.nanoseconds * kNanosecond;
  }
  return cost;
}

}  // namespace solidnoise
