#include "solidnoise/noise/kernel/kernel_family.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solidnoise/core/check.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/compact_gradient.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise {
namespace {

// Integral over the unit ball of function(r).
template <typename Function>
double integrate_over_ball(int dimensions, double waves, const Function& function) {
  const int panels = 4 + static_cast<int>(waves);
  return unit_sphere_area(dimensions) *
         integrate([&](double r) { return function(r) * std::pow(r, dimensions - 1); }, 0.0, 1.0, panels);
}

// Means over directions of the square and of the fourth power of the cosine of a wave with `cycles` periods
// in the unit radius, at distance r.
double mean_square_cosine(int dimensions, double cycles, double r) {
  return 0.5 + 0.5 * mean_cosine(dimensions, 4.0 * kPi * cycles * r);
}
double mean_fourth_cosine(int dimensions, double cycles, double r) {
  return 0.375 + 0.5 * mean_cosine(dimensions, 4.0 * kPi * cycles * r) +
         0.125 * mean_cosine(dimensions, 8.0 * kPi * cycles * r);
}

// The same kernel on the unit ball.
CompactKernel on_unit_ball(const CompactKernel& kernel) {
  const auto chebyshev = kernel.chebyshev_coefficients();
  return CompactKernel(kernel.dimensions(), 1.0, {chebyshev.begin(), chebyshev.end()},
                       kernel.relative_error());
}

// Of frequency 1, so that radii are in cycles; at a given radius, or, if that is 0, at the cheapest one.
template <int Dim>
CompactKernel fit_isotropic(double a, double radius, double error, bool bounds_gradient) {
  const auto kernel = IsotropicGaborKernel<Dim>::with_unit_peak(1.0, a);
  if (radius == 0.0) return compact_kernel(kernel, error, bounds_gradient);
  // At a given a R the truncation error depends on the bandwidth a little; what it leaves is for the fit.
  double beyond = kernel.relative_error(radius);
  if (bounds_gradient) beyond = std::fmax(beyond, gradient_beyond(kernel, radius));
  return compact_kernel_at(kernel, radius, std::fmin(0.9, std::fmax(error, 1.5 * beyond)), bounds_gradient);
}

CompactKernel fit_isotropic(int dimensions, double a, double radius, double error, bool bounds_gradient) {
  switch (dimensions) {
    case 1:
      return fit_isotropic<1>(a, radius, error, bounds_gradient);
    case 2:
      return fit_isotropic<2>(a, radius, error, bounds_gradient);
    case 3:
      return fit_isotropic<3>(a, radius, error, bounds_gradient);
    default:
      return fit_isotropic<4>(a, radius, error, bounds_gradient);
  }
}

template <int Dim>
double nominal_radius(GaborWaves waves, double a) {
  if (waves == GaborWaves::oriented) {
    return RandomPhaseGaborKernel<Dim>(1.0, a, Vec<Dim>(0.0)).radius_for_error(kNominalError);
  }
  return IsotropicGaborKernel<Dim>::with_unit_peak(1.0, a).radius_for_error(kNominalError);
}

double nominal_radius(int dimensions, GaborWaves waves, double a) {
  switch (dimensions) {
    case 1:
      return nominal_radius<1>(waves, a);
    case 2:
      return nominal_radius<2>(waves, a);
    case 3:
      return nominal_radius<3>(waves, a);
    default:
      return nominal_radius<4>(waves, a);
  }
}

}  // namespace

int KernelFamily::Member::degree() const {
  const std::size_t size = power() ? std::max(lower->coefficients.size(), upper->coefficients.size())
                                   : std::max(lower->chebyshev.size(), upper->chebyshev.size());
  return static_cast<int>(size) - 1;
}

KernelFamily::KernelFamily(int dimensions, GaborWaves waves, double bandwidth, double error,
                           bool bounds_gradient)
    : dimensions_(dimensions),
      waves_(waves),
      bandwidth_(bandwidth),
      error_(error),
      bounds_gradient_(bounds_gradient) {
  require_in_range("bandwidth", bandwidth, kLeastBandwidth, kMostBandwidth, "octaves");
  const double a = gaussian_parameter(1.0, bandwidth);
  if (waves == GaborWaves::oriented) {
    const CompactKernel envelope = bounds_gradient
                                       ? compact_gaussian_with_gradient(1.0, 1.0 / a, dimensions, error)
                                       : compact_gaussian(1.0, dimensions, error);
    radius_times_a_ = envelope.radius();
    reference_.emplace(on_unit_ball(envelope));
  } else {
    const CompactKernel kernel = fit_isotropic(dimensions, a, 0.0, error, bounds_gradient);
    radius_times_a_ = kernel.radius() * a;
    reference_.emplace(on_unit_ball(kernel));
  }
  nominal_share_ = nominal_radius(dimensions, waves, a) * a / radius_times_a_;
  reference_cycles_ = radius_times_a_ / a;
  const auto steps_to = [&](double octaves) { return (cycles(octaves) - reference_cycles_) / kStep; };
  // Those of any wavelength have the envelope of an oriented kernel.
  first_ = static_cast<int>(
      std::floor(waves == GaborWaves::oriented ? -reference_cycles_ / kStep : steps_to(kMostBandwidth)));
  const int last = static_cast<int>(std::ceil(steps_to(kLeastBandwidth))) + 1;
  nodes_.resize(static_cast<std::size_t>(last - first_ + 1));
}

double KernelFamily::cycles(double bandwidth) const {
  return bandwidth == bandwidth_ && reference_cycles_ > 0.0
             ? reference_cycles_
             : radius_times_a_ / gaussian_parameter(1.0, bandwidth);
}

std::unique_ptr<const KernelFamily::Tabulated> KernelFamily::make(int step) const {
  const double cycles = reference_cycles_ + step * kStep;
  // Gaussians of the same a R are the same.
  const bool reference = step == 0 || waves_ == GaborWaves::oriented;
  CompactKernel kernel = reference ? *reference_
                                   : on_unit_ball(fit_isotropic(dimensions_, radius_times_a_ / cycles, cycles,
                                                                error_, bounds_gradient_));
  const bool power = kernel.well_conditioned() && kernel.degree() <= kMostHornerDegree;
  auto made = std::make_unique<Tabulated>(Tabulated{std::move(kernel), cycles, power, {}, {}});
  for (const double c : made->kernel.power_coefficients())
    made->coefficients.push_back(static_cast<float>(c));
  for (const double c : made->kernel.chebyshev_coefficients())
    made->chebyshev.push_back(static_cast<float>(c));
  return made;
}

const KernelFamily::Tabulated& KernelFamily::tabulated(int step) const {
  Node& node = nodes_[static_cast<std::size_t>(step - first_)];
  std::call_once(node.made, [&] { node.tabulated = make(step); });
  return *node.tabulated;
}

const KernelFamily::Node& KernelFamily::interval(int step) const {
  const Tabulated& lower = tabulated(step);
  const Tabulated& upper = tabulated(step + 1);
  Node& node = nodes_[static_cast<std::size_t>(step - first_)];
  std::call_once(node.linked, [&] {
    for (int half = 0; half < 3; ++half) {
      const double blend = 0.5 * half;
      const Member member{&lower, &upper, blend, lower.cycles + blend * (upper.cycles - lower.cycles), 0.0};
      node.energy[half] = moments(member).second;
    }
  });
  return node;
}

KernelFamily::Member KernelFamily::at(double bandwidth, double coherence) const {
  if (bandwidth == bandwidth_ && coherence == 1.0) {
    const Tabulated& reference = tabulated(0);
    return {&reference, &reference, 0.0, reference.cycles, interval(0).energy[0]};
  }
  Member member;
  member.cycles = coherence * cycles(bandwidth);
  const double position = (member.cycles - reference_cycles_) / kStep;
  const int last = first_ + static_cast<int>(nodes_.size()) - 2;
  const int step = std::clamp(static_cast<int>(std::floor(position)), first_, last);
  const Node& node = interval(step);
  member.lower = &tabulated(step);
  member.upper = &tabulated(step + 1);
  member.blend = position - step;
  const double x = member.blend;
  // The parabola through the three energies.
  const auto [e0, e1, e2] = node.energy;
  member.energy = e0 + x * (4.0 * e1 - 3.0 * e0 - e2) + x * x * (2.0 * e0 - 4.0 * e1 + 2.0 * e2);
  return member;
}

// With s = a^2 + b^2 the filtered kernel has a' = a b / sqrt(s), F' = F b^2 / s, whatever its waves, and the
// peak (a' / a)^n exp(-pi F^2 / s). In n dimensions its energy is, by C(x) = mean_exponential_scaled(n, x),
//   peak^2 a'^-n (1 + exp(-2 pi F'^2 / a'^2))  of one wave,  peak^2 a'^-n C(pi F'^2 / a'^2)  of all
//   directions,
// times what is the same before and after.
KernelFamily::Filtered KernelFamily::filtered(double frequency, double bandwidth, double deviation,
                                              double coherence) const {
  const double a = gaussian_parameter(frequency, bandwidth);
  frequency *= coherence;
  const double b = filter_bandwidth(deviation);
  const double sum = a * a + b * b;
  const double after = a * b / std::sqrt(sum);
  Filtered result{at(bandwidth, coherence), frequency * b * b / sum, a / after, 0.0, 0.0};
  const double peak = std::pow(after / a, dimensions_) * std::exp(-kPi * frequency * frequency / sum);
  const auto waves = [&](double f, double width) {
    const double x = kPi * (f / width) * (f / width);
    return waves_ == GaborWaves::oriented ? 1.0 + std::exp(-2.0 * x)
                                          : mean_exponential_scaled(dimensions_, x);
  };
  result.variance = peak * peak * std::pow(result.widening, dimensions_) * waves(result.frequency, after) /
                    waves(frequency, a);
  constexpr double kWidest = 4.0;  // of impulses around a tile of points no more are looked at
  const FilteredShare share{std::sqrt(result.variance), result.widening};
  if (share.nothing(0.1 * error_) || result.widening > kWidest) {
    return {at(bandwidth, coherence), frequency, 1.0, 0.0, 0.0};
  }
  result.peak = peak;
  result.kernel = at(std::min(bandwidth_in_octaves(result.frequency, after), kMostBandwidth));
  return result;
}

CompactKernel KernelFamily::compact(const Member& member) const {
  const auto lower = member.lower->kernel.chebyshev_coefficients();
  const auto upper = member.upper->kernel.chebyshev_coefficients();
  std::vector<double> chebyshev(std::max(lower.size(), upper.size()), 0.0);
  for (std::size_t k = 0; k < lower.size(); ++k) chebyshev[k] += (1.0 - member.blend) * lower[k];
  for (std::size_t k = 0; k < upper.size(); ++k) chebyshev[k] += member.blend * upper[k];
  const double error =
      std::fmax(member.lower->kernel.relative_error(), member.upper->kernel.relative_error());
  return CompactKernel(dimensions_, 1.0, std::move(chebyshev), error);
}

KernelMoments KernelFamily::moments(const Member& member) const {
  const CompactKernel kernel = compact(member);
  if (waves_ == GaborWaves::isotropic) return {kernel.energy(), kernel.fourth_moment()};
  const auto second = [&](double r) {
    return std::pow(kernel.value(r), 2) * mean_square_cosine(dimensions_, member.cycles, r);
  };
  const auto fourth = [&](double r) {
    return std::pow(kernel.value(r), 4) * mean_fourth_cosine(dimensions_, member.cycles, r);
  };
  return {integrate_over_ball(dimensions_, 2.0 * member.cycles, second),
          integrate_over_ball(dimensions_, 4.0 * member.cycles, fourth)};
}

}  // namespace solidnoise
