#include "solidnoise/noise/interpolation/interpolation_plan.h"

#include <algorithm>
#include <cstddef>

#include "solidnoise/noise/interpolation/interpolation_choice.h"

namespace solidnoise {
namespace {

// How much more than of the quantity itself the error may be of differences of neighbours, which is of errors
// at two places that know nothing of each other: shading follows differences, and where waves are long they
// are small.
constexpr double kDifferenceError = 5.0;

}  // namespace

template <int Dim>
InterpolationPlanner<Dim>::InterpolationPlanner(const Noise<Dim>& noise, const LatticeFrame<Dim>& frame)
    : frame_(frame) {
  for (const auto& part : noise.parts()) {
    parts_.push_back({part.noise->waves(), {}, part.amplitude * part.amplitude});
  }
  if (parts_.empty()) parts_.push_back({noise.waves(), {}, 1.0});
  for (Part& part : parts_) {
    for (int axis = 0; axis < Dim; ++axis) {
      part.along[static_cast<std::size_t>(axis)] =
          part.waves.along(axis, frame.step[axis], kWidestStep.distances());
    }
  }
}

// The mean square of the quantity, or so many times half that of its differences between neighbours, the mean
// over the axes, if that is less.
template <int Dim>
double InterpolationPlanner<Dim>::power_of(Quantity quantity) const {
  double power = 0.0;
  double difference = 0.0;
  for (const Part& part : parts_) {
    for (const AxisCovariance& along : part.along) {
      const auto at = [&](std::size_t k) {
        return quantity == Quantity::values ? along.value[k] : along.slope[k] + along.lateral[k];
      };
      power += part.power * at(0) / Dim;
      difference += part.power * (at(0) - at(1)) / Dim;
    }
  }
  return std::min(power, kDifferenceError * kDifferenceError * difference);
}

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
  const double budget = error * error * power_of(quantity);
  std::vector<PartChoice<Dim>> choices;
  for (const auto& [waves, along, power] : parts_) {
    choices.emplace_back(waves, along, power, frame_, budget, quantity);
  }
  std::vector<InterpolationPlan<Dim>> plans(parts_.size());

  // Errors of axes do not quite add up: choose again within less, where all together go over the budget.
  double allowed = budget;
  while (true) {
    const std::vector<std::size_t> chosen = choose_within(choices, allowed);
    double total = 0.0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      plans[i].axes = choices[i].options()[chosen[i]].axes;
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
