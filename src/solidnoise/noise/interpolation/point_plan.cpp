#include "solidnoise/noise/interpolation/point_plan.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "solidnoise/noise/interpolation/cheapest_ways.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"

namespace solidnoise {
namespace {

// In steps of the frame, as fractions of whole numbers, for the sake of periods.
struct Spacing {
  int over;
  int under;

  double value() const { return static_cast<double>(over) / under; }
  bool divides(const LatticeFrame<3>& frame) const {
    const auto divides_along = [&](int axis) { return frame.period[axis] * under % over == 0; };
    return divides_along(0) && divides_along(1) && divides_along(2);
  }
};
constexpr std::array kSpacings{Spacing{16, 1}, Spacing{12, 1}, Spacing{8, 1}, Spacing{6, 1},
                               Spacing{4, 1},  Spacing{3, 1},  Spacing{2, 1}, Spacing{3, 2},
                               Spacing{1, 1},  Spacing{2, 3},  Spacing{1, 2}};

struct Taps {
  int count;
  double nanoseconds;  // of a point, in the unit of sum_nanoseconds()
};
constexpr std::array kPointTaps{Taps{4, 8.0}, Taps{6, 16.0}, Taps{8, 26.0}};

// What the sum costs at a point: its impulses are culled for few points, and summed without regard to axes.
constexpr double kPerPointImpulse = 2.5;

// Places between two samples, over which errors are averaged.
constexpr int kPlaces = 4;

struct PointWay {
  double spacing = 0.0;
  int taps = 0;
  double cost = 0.0;
  double squared_error = 0.0;
};

// What the points of a block of the lattice need, which stays in memory with those of other threads.
constexpr double kMostSamples = 0x1p22;
double samples_of_block(const LatticeFrame<3>& frame, const Vec<3>& step, const PointSpread& spread) {
  constexpr double kBlock = 32.0;
  const Vec<3> along = (kBlock * frame.step + 2.0 * spread.reach) / step;
  return along.x * along.y * along.z;
}

// Waves have two samples each at the least. Once the fewest taps err by next to nothing, closer samples only
// cost more.
std::vector<PointWay> point_ways(const NoisePart<3>& part, double highest, const LatticeFrame<3>& frame,
                                 double budget, const PointSpread& spread) {
  constexpr double kNextToNothing = 1.0 / 16.0;
  const WaveMixture<3>& waves = part.waves;
  std::vector<PointWay> ways{{.cost = kPerPointImpulse * waves.impulses}};
  if (waves.waves.empty() || budget == 0.0) return ways;
  for (const Spacing& spacing : kSpacings) {
    const double h = spacing.value();
    const Vec<3> step = h * frame.step;
    if (!spacing.divides(frame) || 2.0 * highest * std::max({step.x, step.y, step.z}) > 1.0) continue;
    if (samples_of_block(frame, step, spread) > kMostSamples) break;
    std::array<AxisCovariance, 3> along;
    for (int axis = 0; axis < 3; ++axis) {
      along[static_cast<std::size_t>(axis)] =
          waves.along(axis, step[axis] / kPlaces, AxisStep{kPlaces, kPointTaps.back().count}.distances());
    }
    const double sums = spread.volume * sum_nanoseconds<3>(waves, step) / (h * h * h);
    double least_of_few = 0.0;
    for (const Taps& taps : kPointTaps) {
      double squared_error = 0.0;  // as if of each axis by itself
      for (const AxisCovariance& covariance : along) {
        squared_error +=
            part.power * AxisWeights({kPlaces, taps.count}, covariance).squared_error(covariance.value);
      }
      if (taps.count == kPointTaps.front().count) least_of_few = squared_error;
      if (squared_error <= budget) ways.push_back({h, taps.count, sums + taps.nanoseconds, squared_error});
    }
    if (least_of_few <= kNextToNothing * budget) break;
  }
  return best_of(ways);
}

double error_of(const NoisePart<3>& part, const PointWay& way, const LatticeFrame<3>& frame) {
  if (way.spacing == 0.0) return 0.0;
  const Vec<3> step = way.spacing * frame.step;
  return part.power * predict_error<3>(part.waves, step / double{kPlaces},
                                       point_weights(part.waves, step, kPlaces, way.taps))
                          .interpolation;
}

}  // namespace

LatticeWeights point_weights(const WaveMixture<3>& waves, const Vec<3>& step, int places, int taps) {
  const AxisStep shape{places, taps};
  LatticeWeights weights;
  for (int axis = 0; axis < 3; ++axis) {
    weights.values.emplace_back(shape, waves.along(axis, step[axis] / places, shape.distances()));
  }
  return weights;
}

std::vector<PointPlan> plan_points(const Noise<3>& noise, const LatticeFrame<3>& frame, double error,
                                   const PointSpread& spread) {
  constexpr int kNeighbours = 2;
  const auto parts = parts_on_lattice<3>(noise, frame.step, kNeighbours);
  const auto views = noise.parts();
  const double budget = squared_budget<3>(parts, error, Quantity::values);
  std::vector<std::vector<PointWay>> ways;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double highest = (views.empty() ? noise.band() : views[i].noise->band()).upper;
    ways.push_back(point_ways(parts[i], highest, frame, budget, spread));
  }

  // Errors of axes do not quite add up: choose again within less, where all together go over the budget.
  std::vector<PointPlan> plans(parts.size());
  double allowed = budget;
  while (true) {
    const std::vector<std::size_t> chosen = choose_within(ways, allowed);
    double total = 0.0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const PointWay& way = ways[i][chosen[i]];
      plans[i] = {way.spacing, way.taps, error_of(parts[i], way, frame), way.cost};
      total += plans[i].squared_error;
    }
    if (total <= budget) return plans;
    allowed *= std::min(0.9, budget / total);
  }
}

}  // namespace solidnoise
