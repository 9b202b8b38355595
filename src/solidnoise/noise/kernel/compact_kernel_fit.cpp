#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/memo.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {
namespace {

constexpr int kMostDegree = 400;  // of a fit at a given radius: what needs more cannot be fitted there

// What is to be approximated: a radial function in n dimensions.
struct RadialFunction {
  int dimensions;
  std::function<double(double)> value;  // of r
  double energy;                        // integral of its square over space
  double tail_radius;                   // where cutting it off alone reaches the wanted error
  double frequency;                     // that of its oscillation along r; 0 for none
};

// What an impulse costs with a compact kernel: (degree + fixed) radius^dimensions, where sums are compiled
// for even degrees.
struct ImpulseCost {
  int fixed;
  int dimensions;

  double operator()(int degree, double radius) const {
    return ((degree + 1) / 2 * 2 + fixed) * std::pow(radius, dimensions);
  }
};

// The functions t^3 q_k(v), k = 0 to some degree, orthonormal over the unit ball of n dimensions, sampled at
// the nodes of a quadrature in r. Over the ball, t^6 r^(n-1) dr is proportional to (1 - u)^(n/2 - 1) (1 +
// u)^6 du with u = 2 v: the q_k are Jacobi polynomials of u. Coefficients of a projection on them do not
// depend on how many there are, so that one projection gives the error of every degree.
class TaperedBasis {
 public:
  TaperedBasis(int dimensions, int degree);

  int degree() const { return static_cast<int>(projector_.rows()) - 1; }

  // Coefficients of the projection of x -> function(radius x), x in the unit ball.
  Eigen::VectorXd project(const RadialFunction& function, double radius) const;

  // Sum of c_k q_k(v).
  double polynomial(const Eigen::VectorXd& coefficients, int degree, double v) const;

 private:
  Eigen::VectorXd nodes_;      // r, in ]0, 1[
  Eigen::MatrixXd projector_;  // row k: weight t^3 q_k at each node
  std::vector<double> alpha_;  // v q_k = beta_(k+1) q_(k+1) + alpha_k q_k + beta_k q_(k-1)
  std::vector<double> beta_;
  double q0_ = 1.0;
};

TaperedBasis::TaperedBasis(int dimensions, int degree) {
  // Exact for products of two basis functions (degree 4 (degree + 3) in r), with some to spare for the
  // function.
  const int count = 2 * degree + 40;
  const QuadratureRule rule = gauss_legendre(count);
  nodes_ = 0.5 * (1.0 + Eigen::Map<const Eigen::ArrayXd>(rule.nodes.data(), count));
  const Eigen::ArrayXd weights = 0.5 * unit_sphere_area(dimensions) *
                                 Eigen::Map<const Eigen::ArrayXd>(rule.weights.data(), count) *
                                 nodes_.array().pow(dimensions - 1);
  const Eigen::ArrayXd t = 1.0 - nodes_.array().square();
  const Eigen::ArrayXd v = t - 0.5;
  const Eigen::ArrayXd tapers = weights * t.pow(CompactKernel::kTaper);

  // Recurrence of orthonormal Jacobi polynomials (Gautschi 2004, table 1.1), for u = 2 v.
  const double p = 0.5 * dimensions - 1.0;
  const double q = 2.0 * CompactKernel::kTaper;
  for (int k = 0; k <= degree + 1; ++k) {
    const double c = 2.0 * k + p + q;
    alpha_.push_back(0.5 * (q * q - p * p) / (c * (c + 2.0)));
    beta_.push_back(std::sqrt(k * (k + p) * (k + q) * (k + p + q) / ((c + 1.0) * (c - 1.0))) / c);
  }

  projector_.resize(degree + 1, count);
  q0_ = 1.0 / std::sqrt((tapers * t.pow(CompactKernel::kTaper)).sum());
  Eigen::ArrayXd previous = Eigen::ArrayXd::Zero(count);
  Eigen::ArrayXd current = Eigen::ArrayXd::Constant(count, q0_);
  for (int k = 0; k <= degree; ++k) {
    projector_.row(k) = (tapers * current).matrix().transpose();
    const auto i = static_cast<std::size_t>(k);
    const Eigen::ArrayXd next = ((v - alpha_[i]) * current - beta_[i] * previous) / beta_[i + 1];
    previous = current;
    current = next;
  }
}

Eigen::VectorXd TaperedBasis::project(const RadialFunction& function, double radius) const {
  return projector_ * nodes_.unaryExpr([&](double x) { return function.value(radius * x); });
}

// The same serves all kernels of a degree, such as those of octaves.
std::shared_ptr<const TaperedBasis> tapered_basis(int dimensions, int degree) {
  thread_local Memo<std::pair<int, int>, TaperedBasis, 2> known;
  return known.get({dimensions, degree}, [&] { return TaperedBasis(dimensions, degree); });
}

double TaperedBasis::polynomial(const Eigen::VectorXd& coefficients, int degree, double v) const {
  double previous = 0.0;
  double current = q0_;
  double sum = coefficients[0] * current;
  for (int k = 0; k < degree; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double next = ((v - alpha_[i]) * current - beta_[i] * previous) / beta_[i + 1];
    previous = current;
    current = next;
    sum += coefficients[k + 1] * current;
  }
  return sum;
}

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
  // Squared relative errors of all degrees at a radius; they fall with the degree.
  Eigen::ArrayXd squared_errors(double radius) const {
    const Eigen::ArrayXd energies = basis_.project(function_, radius).array().square() *
                                    std::pow(radius, function_.dimensions) / function_.energy;
    Eigen::ArrayXd errors(energies.size());
    double left = 1.0;
    for (Eigen::Index k = 0; k < energies.size(); ++k) errors[k] = left -= energies[k];
    return errors;
  }

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
    const Eigen::ArrayXd errors = squared_errors(next);
    while (lowest > 1 && errors[lowest - 1] <= squared_error_) {
      --lowest;
      brackets.push_back({lowest, radius, next});
      least_upper_cost = std::min(least_upper_cost, cost_(lowest, next));
    }
    radius = next;
  }

  std::optional<Choice> best;
  for (const Bracket& bracket : brackets) {
    if (cost_(bracket.degree, bracket.lower) > least_upper_cost) continue;
    const auto excess = [&](double r) { return squared_errors(r)[bracket.degree] - squared_error_; };
    const double smallest = bisect(excess, bracket.lower, bracket.upper);
    if (!best || cost_(bracket.degree, smallest) < cost_(best->degree, best->radius)) {
      best = Choice{bracket.degree, smallest};
    }
  }
  return best;
}

CompactKernel assemble(const RadialFunction& function, const TaperedBasis& basis, const Choice& choice) {
  const Eigen::VectorXd coefficients = basis.project(function, choice.radius);

  // From values of t P at Chebyshev points to Chebyshev coefficients.
  const int count = choice.degree + 2;
  std::vector<double> chebyshev(static_cast<std::size_t>(count), 0.0);
  for (int j = 0; j < count; ++j) {
    const double angle = kPi * (j + 0.5) / count;
    const double v = 0.5 * std::cos(angle);
    const double value = (v + 0.5) * basis.polynomial(coefficients, choice.degree, v);
    for (int k = 0; k < count; ++k) {
      chebyshev[static_cast<std::size_t>(k)] += (k == 0 ? 1.0 : 2.0) / count * value * std::cos(k * angle);
    }
  }
  const double captured =
      coefficients.head(choice.degree + 1).squaredNorm() * std::pow(choice.radius, function.dimensions);
  return CompactKernel(function.dimensions, choice.radius, std::move(chebyshev),
                       std::sqrt(1.0 - captured / function.energy));
}

CompactKernel best_compact(const RadialFunction& function, const ImpulseCost& cost, double error) {
  // A polynomial of degree d in r^2 follows about d/2 cycles over the radius. With twice the degree that the
  // function's oscillation needs, the second attempt is rare.
  int degree = 16 + static_cast<int>(2.0 * kPi * function.frequency * function.tail_radius);
  for (;; degree *= 2) {
    const auto basis = tapered_basis(function.dimensions, degree);
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
    const auto basis = tapered_basis(function.dimensions, degree);
    const Eigen::VectorXd coefficients = basis->project(function, radius);
    double left = function.energy / std::pow(radius, function.dimensions);
    const double allowed = error * error * left;
    for (int k = 0; k <= degree; ++k) {
      left -= coefficients[k] * coefficients[k];
      if (k >= 1 && left <= allowed) return assemble(function, *basis, {k, radius});
    }
    if (degree > kMostDegree) {
      throw std::invalid_argument(fmt::format(
          "radius is {}; at that radius the kernel's relative RMS error cannot be {}", radius, error));
    }
  }
}

}  // namespace

template <int Dim>
CompactKernel compact_kernel(const IsotropicGaborKernel<Dim>& kernel, double error) {
  require_in_range("error", error, 1e-5, 0.9, "relative RMS error");
  return best_compact({Dim, [&](double r) { return kernel.value(r); }, kernel.energy(),
                       kernel.radius_for_error(error), kernel.frequency()},
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
  return best_compact({1, gaussian, 1.0 / (std::numbers::sqrt2 * a), tail_radius, 0.0},
                      ImpulseCost{13, dimensions}, own_error);
}

template <int Dim>
CompactKernel compact_kernel(const IsotropicGaborKernel<Dim>& kernel, double radius, double error) {
  require_in_range("error", error, 1e-5, 0.9, "relative RMS error");
  return compact_at(
      {Dim, [&](double r) { return kernel.value(r); }, kernel.energy(), radius, kernel.frequency()}, radius,
      error);
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
  return best_compact({dimensions, gaussian, energy, tail_radius, 0.0}, ImpulseCost{17, dimensions}, error);
}

template CompactKernel compact_kernel(const IsotropicGaborKernel<1>&, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<2>&, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<3>&, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<4>&, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<1>&, double, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<2>&, double, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<3>&, double, double);
template CompactKernel compact_kernel(const IsotropicGaborKernel<4>&, double, double);

}  // namespace solidnoise
