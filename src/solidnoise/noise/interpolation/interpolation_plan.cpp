#include "solidnoise/noise/interpolation/interpolation_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace solidnoise {
namespace {

// How much more than of values the error may be of differences of neighbours, which is of errors at two
// places that know nothing of each other: shading follows differences, and where waves are long they are
// small.
constexpr double kDifferenceError = 5.0;

constexpr std::array kSteps{2, 3, 4, 5, 6, 8, 10, 12, 16};
constexpr std::array kTaps{4, 6, 8};
constexpr int kLongest = 16 * 8;  // samples that weights reach over

// One axis, interpolated one way.
struct AxisOption {
  AxisStep shape;
  double squared_error = 0.0;  // as if the field varied along this axis alone
};

// Each way that errs by no more than `budget`; not at all comes first.
std::vector<AxisOption> axis_options(std::span<const double> covariance, double budget) {
  std::vector<AxisOption> options{{AxisStep{}, 0.0}};
  for (const int taps : kTaps) {
    for (const int step : kSteps) {
      const AxisStep shape{step, taps};
      const double error = std::max(0.0, AxisWeights(shape, covariance).squared_error(covariance));
      if (error > budget) break;  // it grows with the step
      options.push_back({shape, error});
    }
  }
  return options;
}

// What a sample costs, in nanoseconds on a processor with AVX-512; only ratios matter. Fitted to isotropic
// kernels in 3 dimensions: impulses cost the more, the fewer samples their kernel covers.
template <int Dim>
double cost_per_sample(const WaveMixture<Dim>& waves, const Vec<Dim>& step,
                       const std::array<AxisStep, Dim>& axes) {
  constexpr double kLeaf = 8.0;  // samples along a leaf's side, which needs coarse samples around it, too
  constexpr double kPerImpulse = 0.195;
  constexpr double kCrowding = 12.0;
  constexpr double kPerTap = 0.04;
  double evaluated = 1.0;
  double covered = 1.0;  // samples within the radius, along an axis, their geometric mean
  double interpolation = 0.0;
  double width = 1.0;  // of what an axis' interpolation goes over, relative to the leaf
  for (int axis = 0; axis < Dim; ++axis) {
    const auto [multiple, taps] = axes[static_cast<std::size_t>(axis)];
    evaluated /= multiple;
    covered *= std::pow(waves.radius / (step[axis] * multiple), 1.0 / Dim);
    interpolation += kPerTap * width * (axis == Dim - 1 ? kLeaf / multiple + taps - 1 : taps);
    width *= 1.0 / multiple + (taps - 1) / kLeaf;
  }
  if (evaluated == 1.0) interpolation = 0.0;
  return evaluated * kPerImpulse * waves.impulses * (1.0 + kCrowding / covered) + interpolation;
}

// All ways to interpolate a part that no other one beats both in cost and in error, the costliest first.
template <int Dim>
struct PartChoice {
  struct Option {
    std::array<AxisStep, Dim> axes{};
    double cost = 0.0;
    double squared_error = 0.0;
  };

  WaveMixture<Dim> waves;
  double power = 1.0;  // squared amplitude
  std::vector<Option> options;

  PartChoice(WaveMixture<Dim> mixture, double amplitude, const Vec<Dim>& step, double budget)
      : waves(std::move(mixture)), power(amplitude * amplitude) {
    if (waves.waves.empty()) {
      options.emplace_back();
      return;
    }
    std::array<std::vector<AxisOption>, Dim> per_axis;
    for (int axis = 0; axis < Dim; ++axis) {
      per_axis[static_cast<std::size_t>(axis)] =
          axis_options(waves.along(axis, step[axis], kLongest + 1), budget / power);
    }
    add_combinations(per_axis, step);
    keep_best();
  }

 private:
  void add_combinations(const std::array<std::vector<AxisOption>, Dim>& per_axis, const Vec<Dim>& step) {
    std::array<std::size_t, Dim> index{};
    while (true) {
      Option option;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        option.axes[axis] = per_axis[axis][index[axis]].shape;
        option.squared_error += power * per_axis[axis][index[axis]].squared_error;
      }
      option.cost = cost_per_sample<Dim>(waves, step, option.axes);
      options.push_back(option);
      std::size_t axis = 0;
      while (axis < Dim && ++index[axis] == per_axis[axis].size()) index[axis++] = 0;
      if (axis == Dim) return;
    }
  }

  void keep_best() {
    std::stable_sort(options.begin(), options.end(), [](const Option& a, const Option& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.squared_error < b.squared_error;
    });
    double least = std::numeric_limits<double>::infinity();
    std::erase_if(options, [&](const Option& option) {
      if (option.squared_error >= least) return true;
      least = option.squared_error;
      return false;
    });
  }
};

// For a price of squared error, the best option of each part; returns their error.
template <int Dim>
double choose(const std::vector<PartChoice<Dim>>& parts, double price, std::vector<std::size_t>& chosen) {
  double error = 0.0;
  chosen.clear();
  for (const PartChoice<Dim>& part : parts) {
    const auto total = [&](const auto& option) { return option.cost + price * option.squared_error; };
    const auto best = std::min_element(part.options.begin(), part.options.end(),
                                       [&](const auto& a, const auto& b) { return total(a) < total(b); });
    chosen.push_back(static_cast<std::size_t>(best - part.options.begin()));
    error += best->squared_error;
  }
  return error;
}

// The choice of evaluating all directly: the last and most exact one of each part.
template <int Dim>
std::vector<std::size_t> direct(const std::vector<PartChoice<Dim>>& parts) {
  std::vector<std::size_t> chosen;
  for (const PartChoice<Dim>& part : parts) chosen.push_back(part.options.size() - 1);
  return chosen;
}

// The cheapest choice within a budget of squared error, at one price for all parts.
template <int Dim>
std::vector<std::size_t> choose_within(const std::vector<PartChoice<Dim>>& parts, double budget) {
  std::vector<std::size_t> chosen;
  if (budget == 0.0) return direct<Dim>(parts);
  double low = 0.0;
  if (choose(parts, low, chosen) <= budget) return chosen;
  double high = 1.0 / budget;
  while (choose(parts, high, chosen) > budget) high *= 16.0;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = low == 0.0 ? high / 16.0 : std::sqrt(low * high);
    (choose(parts, middle, chosen) > budget ? low : high) = middle;
  }
  choose(parts, high, chosen);
  return chosen;
}

// The mean square errors of a part of unit amplitude, without approximation.
template <int Dim>
void predict_errors(const WaveMixture<Dim>& waves, const Vec<Dim>& step, InterpolationPlan<Dim>& plan) {
  plan.truncation = waves.truncation;
  plan.squared_error = 0.0;
  if (plan.direct()) return;
  const std::vector<AxisWeights> weights = interpolation_weights<Dim>(waves, step, plan);
  std::array<std::vector<double>, Dim> envelope;
  double white = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const AxisWeights& along = weights[static_cast<std::size_t>(axis)];
    white *= along.white_response();
    for (int k = 0; waves.a > 0.0 && k <= along.shape().step * along.shape().taps; ++k) {
      envelope[static_cast<std::size_t>(axis)].push_back(waves.envelope_correlation(k * step[axis]));
    }
  }
  // The product of an axis' responses.
  const auto respond = [&](const Vec<Dim>& frequency, bool enveloped) {
    AxisWeights::Response product;
    for (int axis = 0; axis < Dim; ++axis) {
      const double cosine = std::cos(2.0 * std::numbers::pi * frequency[axis] * step[axis]);
      const auto i = static_cast<std::size_t>(axis);
      const auto response = weights[i].response(
          cosine, enveloped ? std::span<const double>(envelope[i]) : std::span<const double>());
      product.mean *= response.mean;
      product.mean_square *= response.mean_square;
    }
    return product;
  };
  for (const auto& wave : waves.waves) {
    const AxisWeights::Response response = respond(wave.frequency, true);
    plan.squared_error += wave.variance * (1.0 - 2.0 * response.mean + response.mean_square);
  }
  double beyond = waves.truncation;
  plan.truncation = 0.0;
  for (const auto& wave : waves.truncation_waves) {
    plan.truncation += wave.variance * respond(wave.frequency, false).mean_square;
    beyond -= wave.variance;
  }
  plan.truncation += std::max(0.0, beyond) * white;
}

// The mean square error that is allowed.
template <int Dim>
double budget_of(const Noise<Dim>& noise, const Vec<Dim>& step, double error) {
  double difference = 0.0;  // half the mean square of that of neighbours, the mean over the axes
  for (int axis = 0; axis < Dim; ++axis) {
    Vec<Dim> along(0.0);
    along[axis] = step[axis];
    difference += (covariance<Dim>(noise, Vec<Dim>(0.0)) - covariance<Dim>(noise, along)) / Dim;
  }
  return error * error * std::min(noise.variance(), kDifferenceError * kDifferenceError * difference);
}

}  // namespace

template <int Dim>
std::vector<AxisWeights> interpolation_weights(const WaveMixture<Dim>& waves, const Vec<Dim>& step,
                                               const InterpolationPlan<Dim>& plan) {
  std::vector<AxisWeights> weights;
  for (int axis = 0; axis < Dim; ++axis) {
    const AxisStep& shape = plan.axes[static_cast<std::size_t>(axis)];
    weights.emplace_back(shape, waves.along(axis, step[axis], shape.step * shape.taps + 1));
  }
  return weights;
}

template <int Dim>
std::vector<InterpolationPlan<Dim>> plan_interpolation(const Noise<Dim>& noise, const Vec<Dim>& step,
                                                       double error) {
  const double budget = budget_of(noise, step, error);
  std::vector<PartChoice<Dim>> parts;
  for (const auto& part : noise.parts()) {
    parts.emplace_back(part.noise->waves(), part.amplitude, step, budget);
  }
  if (parts.empty()) parts.emplace_back(noise.waves(), 1.0, step, budget);
  std::vector<InterpolationPlan<Dim>> plans(parts.size());

  // Errors of axes do not quite add up: choose again within less, where all together go over the budget.
  double allowed = budget;
  while (true) {
    const std::vector<std::size_t> chosen = choose_within(parts, allowed);
    double total = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      plans[i].axes = parts[i].options[chosen[i]].axes;
      predict_errors<Dim>(parts[i].waves, step, plans[i]);
      plans[i].squared_error *= parts[i].power;
      plans[i].truncation *= parts[i].power;
      total += plans[i].squared_error;
    }
    if (total <= budget) return plans;
    allowed *= std::min(0.9, budget / total);
  }
}

template std::vector<InterpolationPlan<2>> plan_interpolation<2>(const Noise<2>&, const Vec<2>&, double);
template std::vector<InterpolationPlan<3>> plan_interpolation<3>(const Noise<3>&, const Vec<3>&, double);
template std::vector<AxisWeights> interpolation_weights<2>(const WaveMixture<2>&, const Vec<2>&,
                                                           const InterpolationPlan<2>&);
template std::vector<AxisWeights> interpolation_weights<3>(const WaveMixture<3>&, const Vec<3>&,
                                                           const InterpolationPlan<3>&);

}  // namespace solidnoise
