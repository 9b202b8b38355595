#include "solidnoise/noise/interpolation/noise_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/convolution/sparse_convolution.h"

namespace solidnoise {
namespace {

// Measured on the machine that Cost names, all threads busy. What the planner calls nanoseconds are those of
// a sum by itself, which compares ways to make it.
constexpr double kSumsInPractice = 2.0;
constexpr double kSecondsPerImpulseMade = 25e-9;
constexpr double kSecondsPerImpulseOfBrick = 45e-9;     // made for a brick alone, and summed
constexpr double kSecondsPerSampleAndImpulse = 0.5e-9;  // at each of its samples
constexpr double kSecondsPerPointImpulse = 2e-9;
constexpr double kSecondsPerGradientSample = 6e-9;
constexpr double kSecondsPerGradientPoint = 20e-9;  // one by one
constexpr double kNanosecond = 1e-9;
constexpr double kBytesPerImpulse = 56.0;  // of a block

constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;  // the volume of radius 1

template <int Dim, typename Visit>
void for_each_part(const Noise<Dim>& noise, const Visit& visit) {
  const std::vector<typename Noise<Dim>::Part> parts = noise.parts();
  for (std::size_t i = 0; i < parts.size(); ++i) visit(i, parts[i].noise->waves(), parts[i].noise->band());
  if (parts.empty()) visit(0, noise.waves(), noise.band());
}

// Of noises without impulses, whose cells samples far apart do not share: measured with gradients and with
// points, which differ by what the highest frequency of their bands is to a cell's.
double seconds_of_cells(double cycles_per_step) {
  constexpr double kShared = 19e-9;
  constexpr double kMost = 2e-6;
  return std::min(kShared * cycles_per_step * cycles_per_step, kMost);
}

// That a block of so many samples along each axis holds of points in cells; more are made for bricks alone.
double bytes_of_cells(double cycles_per_step, double side) {
  constexpr double kCellsPerCycle = 0.19;
  constexpr double kAround = 3.4;  // cells
  constexpr double kPointsPerCell = 0.5;
  constexpr double kSlack = 1.4;
  const double points = kPointsPerCell * std::pow(kCellsPerCycle * cycles_per_step * side + kAround, 3);
  return points <= kMostImpulsesInBlock ? kSlack * points * kBytesPerImpulse : 0.0;
}

// Radii between samples whose balls do not meet.
constexpr double kApart = 2.0;

// That reach a cube of so many steps along each axis, of which each counts for so many radii at most.
double impulses_around(const WaveMixture<3>& waves, const Vec<3>& step, double steps,
                       double most_radii = std::numeric_limits<double>::infinity()) {
  if (!(waves.radius > 0.0)) return 0.0;
  double impulses = waves.impulses / kBall;
  for (int axis = 0; axis < 3; ++axis) {
    impulses *= std::min(step[axis] / waves.radius, most_radii) * steps + 2.0;
  }
  return impulses;
}

// Of a brick of a lattice that is so many samples along each axis, with impulses of its own. An impulse is
// summed where it reaches, in whole rows.
double seconds_of_brick(const WaveMixture<3>& waves, const Vec<3>& step, double side) {
  double samples = side;
  for (int axis = 0; axis < 2; ++axis) samples *= std::min(side, 2.0 * waves.radius / step[axis] + 1.0);
  return impulses_around(waves, step, side - 1.0, kApart) *
         (kSecondsPerImpulseOfBrick + waves.work * kSecondsPerSampleAndImpulse * samples);
}

// Of all impulses in the cells that a brick alone sees, and of those among them that reach it: measured with
// 1e4 to 1e5 in a kernel, at steps of .2 to .9 radii.
double bytes_of_brick(const WaveMixture<3>& waves, const Vec<3>& step, double side) {
  constexpr double kLongest = 7.2;  // radii
  constexpr double kBytes = 100.0;
  constexpr double kPerStep = 1.3;
  constexpr double kAround = 2.9;
  const double most = std::floor(kLongest * waves.radius / std::max({step.x, step.y, step.z}));
  const double steps = std::min(side, std::max(1.0, most)) - 1.0;
  double bytes = kBytes * waves.impulses / kBall;
  for (int axis = 0; axis < 3; ++axis) bytes *= kPerStep * step[axis] / waves.radius * steps + kAround;
  return bytes;
}

// Of those that a batch of points makes, each one's share.
template <int Dim>
double impulses_made_for_point(const WaveMixture<Dim>& waves, const PointWork& work) {
  constexpr double kBatch = 1024.0;
  constexpr double kBalls[] = {2.0, std::numbers::pi, kBall, 0.5 * std::numbers::pi * std::numbers::pi};
  if (!(waves.radius > 0.0)) return 0.0;
  const double along = std::min(work.spacing / waves.radius, kApart);
  const double side = std::pow(kBatch, 1.0 / work.axes);
  const int spread = std::min(work.axes, Dim);
  return waves.impulses / kBalls[Dim - 1] / kBatch * std::pow(along * (side - 1.0) + 2.0, spread) *
         std::pow(2.0, Dim - spread);
}

}  // namespace

ImpulsesHeld impulses_held(const WaveMixture<3>& waves, const Vec<3>& step, double side) {
  const double of_cube = impulses_around(waves, step, side);
  if (of_cube <= kMostImpulsesInBlock) return {of_cube, side, of_cube * kBytesPerImpulse};
  // Bricks are of fewer samples where these are far apart (LocatedAxis); cells are as large as the radius at
  // most.
  const double longest = CellAxis::kMaxSpan * waves.radius / std::max({step.x, step.y, step.z});
  const double of_brick = std::min<double>({side, SampleBrick::kSide, std::max(1.0, std::floor(longest))});
  return {impulses_around(waves, step, of_brick, kApart), of_brick, bytes_of_brick(waves, step, of_brick)};
}

Cost cost_on_lattice(const Noise<3>& noise, const LatticeFrame<3>& frame, const LatticeWork& work,
                     const std::vector<InterpolationPlan<3>>& plans) {
  Cost cost;
  const double longest = std::max({frame.step.x, frame.step.y, frame.step.z});
  for_each_part(noise, [&](std::size_t part, const WaveMixture<3>& waves, const Noise<3>::Band& band) {
    if (!(waves.impulses > 0.0)) {
      const double cycles = band.upper * longest;
      cost += {work.samples * (kSecondsPerGradientSample + seconds_of_cells(cycles)),
               bytes_of_cells(cycles, work.side)};
      return;
    }
    const ImpulsesHeld held = impulses_held(waves, frame.step, work.side);
    const double cubes = work.samples / std::pow(held.side, 3);
    double seconds = 0.0;
    if (plans[part].direct() && held.side < work.side) {
      seconds = cubes * seconds_of_brick(waves, frame.step, held.side);
    } else {
      const double sample = waves.work * kSumsInPractice * plans[part].nanoseconds * kNanosecond;
      // Not more than of samples by themselves, which the plan's figure knows nothing of.
      seconds = std::min(work.samples * sample + cubes * held.count * kSecondsPerImpulseMade,
                         work.samples * seconds_of_brick(waves, frame.step, 1.0));
    }
    cost += {seconds, plans[part].direct() ? held.bytes : 0.0};
  });
  return cost;
}

template <int Dim>
Cost cost_at_points(const Noise<Dim>& noise, const PointWork& work) {
  Cost cost;
  for_each_part(noise, [&](std::size_t, const WaveMixture<Dim>& waves, const auto& band) {
    cost.seconds +=
        work.points * (waves.impulses > 0.0
                           ? waves.work * waves.impulses * kSecondsPerPointImpulse +
                                 impulses_made_for_point(waves, work) * kSecondsPerImpulseOfBrick
                           : kSecondsPerGradientPoint + seconds_of_cells(band.upper * work.spacing));
    cost.bytes += waves.impulses * kBytesPerImpulse;
  });
  return cost;
}

template Cost cost_at_points(const Noise<1>&, const PointWork&);
template Cost cost_at_points(const Noise<2>&, const PointWork&);
template Cost cost_at_points(const Noise<3>&, const PointWork&);
template Cost cost_at_points(const Noise<4>&, const PointWork&);

Cost cost_at_points(const Noise<3>& noise, double points, const std::vector<PointPlan>& plans) {
  Cost cost = cost_at_points(noise, PointWork{points});
  cost.seconds = 0.0;
  for_each_part(noise, [&](std::size_t part, const WaveMixture<3>& waves, const auto&) {
    cost.seconds += waves.work * points * kSumsInPractice * plans[part].nanoseconds * kNanosecond;
  });
  return cost;
}

}  // namespace solidnoise
