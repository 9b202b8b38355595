#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/radial_fit.h"

namespace solidnoise {
namespace {

constexpr int kMostDegree = 400;  // of a fit at a given radius: what needs more cannot be fitted there

// What an impulse costs with a compact kernel: (degree + fixed) radius^dimensions, where sums are compiled
// for even degrees.
struct ImpulseCost {
  int fixed;
  int dimensions;

  double operator()(int degree, double radius) const {
    return ((degree + 1) / 2 * 2 + fixed) * std::pow(radius, dimensions);
  }
};

struct Choice {
  int degree = 0;
  double radius = 0.0;
};

// Finds the cheapest degree and radius of one function and error, among the degrees of one basis.
class Search {
 public:
  Search(const RadialFunction& function, const TaperedBasis& basis, const ImpulseCost& cost, double error)
      : function_(function), basis_(basis), cost_(cost), squared_error_(error * error) {}

  std::optional<Choice> cheapest();

 private:
  const RadialFunction& function_;
  const TaperedBasis& basis_;
  const ImpulseCost& cost_;
  double squared_error_;
};

std::optional<Choice> Search::cheapest() {
  // Walk outwards from where truncation alone would reach the error. A higher degree reaches it at a smaller
  // radius, so each step can only bring lower degrees than the steps before.
  constexpr double kStep = 1.01;
  constexpr double kFarthest = 4.0;
  struct Bracket {
    int degree;
    double lower, upper;
  };
  std::vector<Bracket> brackets;
  double least_upper_cost = std::numeric_limits<double>::infinity();
  int lowest = basis_.degree() + 1;
  double radius = function_.tail_radius;
  for (double next = radius * kStep; next < kFarthest * function_.tail_radius; next *= kStep) {
    if (lowest == 1 || cost_(1, radius) > least_upper_cost) break;
    const RadialFit fit(function_, basis_, next);
    while (lowest > 1 && fit.error(lowest - 1) <= squared_error_) {
      --lowest;
      brackets.push_back({lowest, radius, next});
      least_upper_cost = std::min(least_upper_cost, cost_(lowest, next));
    }
    radius = next;
  }

  std::optional<Choice> best;
  for (const Bracket& bracket : brackets) {
    if (cost_(bracket.degree, bracket.lower) > least_upper_cost) continue;
    const auto excess = [&](double r) {
      return RadialFit(function_, basis_, r).error(bracket.degree) - squared_error_;
    };
    // With slopes, a lower degree may be within the error before a higher one is.
    const double smallest =
        excess(bracket.lower) > 0.0 ? bisect(excess, bracket.lower, bracket.upper) : bracket.lower;
    if (!best || cost_(bracket.degree, smallest) < cost_(best->degree, best->radius)) {
      best = Choice{bracket.degree, smallest};
    }
  }
  return best;
}

CompactKernel assemble(const RadialFunction& function, const TaperedBasis& basis, const Choice& choice) {
  const RadialFit fit(function, basis, choice.radius);
  const Eigen::VectorXd coefficients = fit.coefficients(choice.degree);

  // From values of t^(k - 2) P at Chebyshev points to Chebyshev coefficients.
  const int count = choice.degree + function.taper - 1;
  std::vector<double> chebyshev(static_cast<std::size_t>(count), 0.0);
  for (int j = 0; j < count; ++j) {
    const double angle = kPi * (j + 0.5) / count;
    const double v = 0.5 * std::cos(angle);
    const double value = std::pow(v + 0.5, function.taper - 2) * basis.polynomial(coefficients, v);
    for (int k = 0; k < count; ++k) {
      chebyshev[static_cast<std::size_t>(k)] += (k == 0 ? 1.0 : 2.0) / count * value * std::cos(k * angle);
    }
  }
  return CompactKernel(function.dimensions, choice.radius, std::move(chebyshev),
                       std::sqrt(fit.value_error(coefficients)), function.taper);
}

CompactKernel best_compact(const RadialFunction& function, const ImpulseCost& cost, double error) {
  // A polynomial of degree d in r^2 follows about d/2 cycles over the radius. With twice the degree that the
  // function's oscillation needs, the second attempt is rare.
  int degree = 16 + static_cast<int>(2.0 * kPi * function.frequency * function.tail_radius);
  for (;; degree *= 2) {
    const auto basis = tapered_basis(function, degree);
    const std::optional<Choice> best = Search(function, *basis, cost, error).cheapest();
    // No higher degree can be cheaper once its cost at the smallest conceivable radius is not.
    if (best && cost(degree + 1, function.tail_radius) > cost(best->degree, best->radius)) {
      return assemble(function, *basis, *best);
    }
  }
}

// The lowest degree within the error, at a radius that is given.
CompactKernel compact_at(const RadialFunction& function, double radius, double error) {
  for (int degree = 16 + static_cast<int>(2.0 * kPi * function.frequency * radius);; degree *= 2) {
    const auto basis = tapered_basis(function, degree);
    const RadialFit fit(function, *basis, radius);
    for (int k = 1; k <= degree; ++k) {
      if (fit.error(k) <= error * error) return assemble(function, *basis, {k, radius});
    }
    if (degree > kMostDegree) {
      throw std::invalid_argument(fmt::format(
          "radius is {}; at that radius the kernel's relative RMS error cannot be {}", radius, error));
    }
  }
}

template <int Dim>
RadialFunction function_of(const IsotropicGaborKernel<Dim>& kernel, double tail_radius,
                           bool bounds_gradient) {
  RadialFunction function{
      Dim, [&](double r) { return kernel.value(r); }, kernel.energy(), tail_radius, kernel.frequency(), {}};
  if (bounds_gradient) {
    function.slope = [&](double r) { return kernel.derivative(r); };
    function.slope_energy = kernel.gradient_energy();
  }
  return function;
}

}  // namespace

template <int Dim>
CompactKernel compact_kernel(const IsotropicGaborKernel<Dim>& kernel, double error, bool bounds_gradient) {
  require_in_range("error", error, 1e-5, 0.9, "relative RMS error");
  return best_compact(function_of(kernel, kernel.radius_for_error(error), bounds_gradient),
                      ImpulseCost{5, Dim}, error);
}

CompactKernel compact_envelope(double a, int dimensions, double error) {
  require_positive("a", a, "cycles per world unit");
  require_in_range("error", error, 1e-5, 0.9, "relative RMS error");
  // The product keeps the share (1 - e^2)^dimensions of the energy, if one axis keeps 1 - e^2.
  const double own_error = std::sqrt(-std::expm1(std::log1p(-error * error) / dimensions));
  const auto gaussian = [a](double d) { return std::exp(-kPi * a * a * d * d); };
  const auto excess = [&](double r) {
    return regularized_gamma_q(0.5, 2.0 * kPi * a * a * r * r) - own_error * own_error;
  };
  const double tail_radius = bisect(excess, 0.0, 4.0 / a);
  return best_compact({1, gaussian, 1.0 / (std::numbers::sqrt2 * a), tail_radius, 0.0, {}, 0.0, kAxisTaper},
                      ImpulseCost{13, dimensions}, own_error);
}

template <int Dim>
CompactKernel compact_kernel_at(const IsotropicGaborKernel<Dim>& kernel, double radius, double error,
                                bool bounds_gradient) {
  require_in_range("error", error, 1e-5, 0.9, "relative RMS error");
  return compact_at(function_of(kernel, radius, bounds_gradient), radius, error);
}

CompactKernel compact_gaussian(double a, int dimensions, double error) {
  require_positive("a", a, "cycles per world unit");
  require_in_range("error", error, 1e-5, 0.9, "relative RMS error");
  const auto gaussian = [a](double r) { return std::exp(-kPi * a * a * r * r); };
  const auto excess = [&](double r) {
    return regularized_gamma_q(0.5 * dimensions, 2.0 * kPi * a * a * r * r) - error * error;
  };
  const double energy = std::pow(std::numbers::sqrt2 * a, -dimensions);
  const double tail_radius = bisect(excess, 0.0, 4.0 / a);
  return best_compact({dimensions, gaussian, energy, tail_radius, 0.0, {}}, ImpulseCost{17, dimensions},
                      error);
}

template CompactKernel compact_kernel(const IsotropicGaborKernel<1>&, double, bool);
template CompactKernel compact_kernel(const IsotropicGaborKernel<2>&, double, bool);
template CompactKernel compact_kernel(const IsotropicGaborKernel<3>&, double, bool);
template CompactKernel compact_kernel(const IsotropicGaborKernel<4>&, double, bool);
template CompactKernel compact_kernel_at(const IsotropicGaborKernel<1>&, double, double, bool);
template CompactKernel compact_kernel_at(const IsotropicGaborKernel<2>&, double, double, bool);
template CompactKernel compact_kernel_at(const IsotropicGaborKernel<3>&, double, double, bool);
template CompactKernel compact_kernel_at(const IsotropicGaborKernel<4>&, double, double, bool);

}  // namespace solidnoise
