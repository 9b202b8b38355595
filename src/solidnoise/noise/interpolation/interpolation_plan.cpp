#include "solidnoise/noise/interpolation/interpolation_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solidnoise/noise/interpolation/cheapest_ways.h"

namespace solidnoise {
namespace {

constexpr std::array kSteps{2, 3, 4, 5, 6, 8, 10, 12, kWidestStep.step};
constexpr std::array kTaps{4, 6, kWidestStep.taps};

// One axis, interpolated one way.
struct AxisOption {
  AxisStep shape;
  double squared_error = 0.0;  // as if the field varied along this axis alone
};

double squared_error(AxisStep shape, const AxisCovariance& covariance, Quantity quantity) {
  const AxisWeights values(shape, covariance);
  if (quantity == Quantity::values) return values.squared_error(covariance.value);
  const auto slope = AxisWeights(shape, covariance, AxisWeights::Of::slopes)
                         .response(covariance.value, covariance.value_to_slope);
  return std::max(0.0, covariance.slope[0] - 2.0 * slope.product + slope.square) +
         values.squared_error(covariance.lateral);
}

// Each way that errs by no more than `budget` and divides the period (samples; 0 for none). Values may do
// without; slopes have weights at a step of 1, too.
std::vector<AxisOption> axis_options(const AxisCovariance& covariance, Quantity quantity, double budget,
                                     int period) {
  std::vector<AxisOption> options;
  if (quantity == Quantity::values) options.push_back({AxisStep{}, 0.0});
  for (const int taps : kTaps) {
    for (const int step : kSteps) {
      if (period % step != 0) continue;
      const double error = squared_error({step, taps}, covariance, quantity);
      if (error > budget) break;  // it grows with the step
      options.push_back({{step, taps}, error});
    }
  }
  return options;
}

// What a sample costs that is interpolated, in the unit of sum_nanoseconds().
template <int Dim>
double cost_per_sample(const WaveMixture<Dim>& waves, const Vec<Dim>& step,
                       const std::array<AxisStep, Dim>& axes, Quantity quantity) {
  constexpr double kLeaf = 8.0;  // samples along a leaf's side, which needs coarse samples around it, too
  constexpr double kPerTap = 0.04;
  // Times the cost of a value; alone 1.4 to 2.5 times, with the values 1.8 to 2.9.
  constexpr double kDirectGradient = 2.2;
  const bool gradient = quantity == Quantity::gradient;
  double evaluated = 1.0;
  Vec<Dim> coarse = step;
  double interpolation = 0.0;
  double width = 1.0;  // of what an axis' interpolation goes over, relative to the leaf
  for (int axis = 0; axis < Dim; ++axis) {
    const auto [multiple, taps] = axes[static_cast<std::size_t>(axis)];
    const int arrays = !gradient ? 1 : axis == 0 ? Dim : Dim - axis + 1;
    evaluated /= multiple;
    coarse[axis] *= multiple;
    interpolation += kPerTap * arrays * width * (axis == Dim - 1 ? kLeaf / multiple + taps - 1 : taps);
    width *= 1.0 / multiple + (taps - 1) / kLeaf;
  }
  const double sum = sum_nanoseconds<Dim>(waves, coarse);
  if (axes == std::array<AxisStep, Dim>{}) return gradient ? kDirectGradient * sum : sum;
  return evaluated * sum + interpolation;
}

// All combinations of the axes' options.
template <int Dim, typename Visit>
void for_each_combination(const std::array<std::vector<AxisOption>, Dim>& per_axis, const Visit& visit) {
  std::array<std::size_t, Dim> index{};
  while (true) {
    std::array<AxisStep, Dim> axes;
    double squared_error = 0.0;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      if (per_axis[axis].empty()) return;
      axes[axis] = per_axis[axis][index[axis]].shape;
      squared_error += per_axis[axis][index[axis]].squared_error;
    }
    visit(axes, squared_error);
    std::size_t axis = 0;
    while (axis < Dim && ++index[axis] == per_axis[axis].size()) index[axis++] = 0;
    if (axis == Dim) return;
  }
}

// One way to evaluate a part on a lattice.
template <int Dim>
struct LatticeWay {
  std::array<AxisStep, Dim> axes{};  // steps of 1: directly
  double cost = 0.0;
  double squared_error = 0.0;  // the sum over the axes, each as if the field varied along it alone
};

// The best ways for a part of this mean square amplitude, with errors up to `budget`. `along` each axis up to
// the distances of the widest step.
template <int Dim>
std::vector<LatticeWay<Dim>> lattice_ways(const WaveMixture<Dim>& waves,
                                          const std::array<AxisCovariance, Dim>& along, double power,
                                          const LatticeFrame<Dim>& frame, double budget, Quantity quantity) {
  std::vector<LatticeWay<Dim>> ways{{.cost = cost_per_sample<Dim>(waves, frame.step, {}, quantity)}};
  if (waves.waves.empty() || budget == 0.0) return ways;
  std::array<std::vector<AxisOption>, Dim> per_axis;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    per_axis[axis] =
        axis_options(along[axis], quantity, budget / power, frame.period[static_cast<int>(axis)]);
  }
  for_each_combination<Dim>(per_axis, [&](const std::array<AxisStep, Dim>& axes, double squared_error) {
    ways.push_back({axes, cost_per_sample<Dim>(waves, frame.step, axes, quantity), power * squared_error});
  });
  return best_of(ways);
}

// How much more than of the quantity itself the error may be of differences of neighbours, which is of errors
// at two places that know nothing of each other: shading follows differences, and where waves are long they
// are small.
constexpr double kDifferenceError = 5.0;

}  // namespace

template <int Dim>
double sum_nanoseconds(const WaveMixture<Dim>& waves, const Vec<Dim>& step) {
  constexpr double kPerImpulse = 0.155;
  constexpr double kCrowding = 12.0;
  double covered = 1.0;  // samples within the radius, along an axis, their geometric mean
  for (int axis = 0; axis < Dim; ++axis) covered *= std::pow(waves.radius / step[axis], 1.0 / Dim);
  return kPerImpulse * waves.impulses * (1.0 + kCrowding / covered);
}

template double sum_nanoseconds<2>(const WaveMixture<2>&, const Vec<2>&);
template double sum_nanoseconds<3>(const WaveMixture<3>&, const Vec<3>&);

template <int Dim>
std::vector<NoisePart<Dim>> parts_on_lattice(const Noise<Dim>& noise, const Vec<Dim>& step, int distances) {
  std::vector<NoisePart<Dim>> parts;
  for (const auto& part : noise.parts()) {
    parts.push_back({part.noise->waves(), {}, part.amplitude * part.amplitude});
  }
  if (parts.empty()) parts.push_back({noise.waves(), {}, 1.0});
  for (NoisePart<Dim>& part : parts) {
    for (int axis = 0; axis < Dim; ++axis) {
      part.along[static_cast<std::size_t>(axis)] = part.waves.along(axis, step[axis], distances);
    }
  }
  return parts;
}

// Of the mean square of the quantity, or of so many times half that of its differences between neighbours,
// the mean over the axes, if that is less.
template <int Dim>
double squared_budget(const std::vector<NoisePart<Dim>>& parts, double error, Quantity quantity) {
  double power = 0.0;
  double difference = 0.0;
  for (const NoisePart<Dim>& part : parts) {
    for (const AxisCovariance& along : part.along) {
      const auto at = [&](std::size_t k) {
        return quantity == Quantity::values ? along.value[k] : along.slope[k] + along.lateral[k];
      };
      power += part.power * at(0) / Dim;
      difference += part.power * (at(0) - at(1)) / Dim;
    }
  }
  return error * error * std::min(power, kDifferenceError * kDifferenceError * difference);
}

template std::vector<NoisePart<3>> parts_on_lattice<3>(const Noise<3>&, const Vec<3>&, int);
template double squared_budget<3>(const std::vector<NoisePart<3>>&, double, Quantity);

template <int Dim>
InterpolationPlanner<Dim>::InterpolationPlanner(const Noise<Dim>& noise, const LatticeFrame<Dim>& frame)
    : frame_(frame), parts_(parts_on_lattice<Dim>(noise, frame.step, kWidestStep.distances())) {}

template <int Dim>
LatticeError InterpolationPlanner<Dim>::error_of(std::size_t part, const InterpolationPlan<Dim>& plan,
                                                 Quantity quantity) const {
  const auto& [waves, along, power] = parts_[part];
  LatticeError error;
  if (!plan.direct()) {
    error = predict_error<Dim>(waves, frame_.step, weights(part, plan, quantity));
  } else if (quantity == Quantity::values) {
    error.truncation = waves.truncation;
  }
  return {power * error.interpolation, power * error.truncation};
}

template <int Dim>
LatticeWeights InterpolationPlanner<Dim>::weights(std::size_t part, const InterpolationPlan<Dim>& plan,
                                                  Quantity quantity) const {
  LatticeWeights weights;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const AxisCovariance& along = parts_[part].along[axis];
    weights.values.emplace_back(plan.axes[axis], along);
    if (quantity == Quantity::gradient) {
      weights.slopes.emplace_back(plan.axes[axis], along, AxisWeights::Of::slopes);
    }
  }
  return weights;
}

template <int Dim>
std::vector<InterpolationPlan<Dim>> InterpolationPlanner<Dim>::plan(double error, Quantity quantity) const {
  const double budget = squared_budget<Dim>(parts_, error, quantity);
  std::vector<std::vector<LatticeWay<Dim>>> ways;
  for (const auto& [waves, along, power] : parts_) {
    ways.push_back(lattice_ways<Dim>(waves, along, power, frame_, budget, quantity));
  }
  std::vector<InterpolationPlan<Dim>> plans(parts_.size());

  // Errors of axes do not quite add up: choose again within less, where all together go over the budget.
  double allowed = budget;
  while (true) {
    const std::vector<std::size_t> chosen = choose_within(ways, allowed);
    double total = 0.0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const LatticeWay<Dim>& way = ways[i][chosen[i]];
      plans[i].axes = way.axes;
      plans[i].nanoseconds = way.cost;
      plans[i].error = error_of(i, plans[i], quantity);
      total += plans[i].error.interpolation;
    }
    if (total <= budget) return plans;
    allowed *= std::min(0.9, budget / total);
  }
}

template class InterpolationPlanner<2>;
template class InterpolationPlanner<3>;

}  // namespace solidnoise
