#include "solidnoise/noise/kernel/radial_fit.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Cholesky>

#include "solidnoise/core/memo.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {

TaperedBasis::TaperedBasis(int dimensions, int taper, int degree, bool slopes) {
  // Exact for products of two basis functions (degree 4 (degree + taper) in r), with some to spare for the
  // function.
  const int count = 2 * degree + 40;
  const QuadratureRule rule = gauss_legendre(count);
  nodes_ = 0.5 * (1.0 + Eigen::Map<const Eigen::ArrayXd>(rule.nodes.data(), count));
  const Eigen::ArrayXd weights = 0.5 * unit_sphere_area(dimensions) *
                                 Eigen::Map<const Eigen::ArrayXd>(rule.weights.data(), count) *
                                 nodes_.array().pow(dimensions - 1);
  const Eigen::ArrayXd t = 1.0 - nodes_.array().square();
  const Eigen::ArrayXd v = t - 0.5;
  const Eigen::ArrayXd tapers = weights * t.pow(taper);

  // Recurrence of orthonormal Jacobi polynomials (Gautschi 2004, table 1.1), for u = 2 v.
  const double p = 0.5 * dimensions - 1.0;
  const double q = 2.0 * taper;
  for (int k = 0; k <= degree + 1; ++k) {
    const double c = 2.0 * k + p + q;
    alpha_.push_back(0.5 * (q * q - p * p) / (c * (c + 2.0)));
    beta_.push_back(std::sqrt(k * (k + p) * (k + q) * (k + p + q) / ((c + 1.0) * (c - 1.0))) / c);
  }

  // d(t^m q)/dr = (m t^(m-1) q + t^m q') dt/dr.
  const Eigen::ArrayXd slope_tapers = tapers * (-2.0 * nodes_.array());
  const auto slope_of = [&](const Eigen::ArrayXd& value, const Eigen::ArrayXd& slope) {
    return (slope_tapers * (taper * value / t + slope)).matrix();
  };
  projector_.resize(degree + 1, count);
  if (slopes) slope_projector_.resize(degree + 1, count);
  q0_ = 1.0 / std::sqrt((tapers * t.pow(taper)).sum());
  Eigen::ArrayXd previous = Eigen::ArrayXd::Zero(count);
  Eigen::ArrayXd current = Eigen::ArrayXd::Constant(count, q0_);
  Eigen::ArrayXd previous_slope = Eigen::ArrayXd::Zero(count);
  Eigen::ArrayXd current_slope = Eigen::ArrayXd::Zero(count);
  for (int k = 0; k <= degree; ++k) {
    projector_.row(k) = (tapers * current).matrix().transpose();
    if (slopes) slope_projector_.row(k) = slope_of(current, current_slope).transpose();
    const auto i = static_cast<std::size_t>(k);
    const Eigen::ArrayXd next = ((v - alpha_[i]) * current - beta_[i] * previous) / beta_[i + 1];
    const Eigen::ArrayXd next_slope =
        (current + (v - alpha_[i]) * current_slope - beta_[i] * previous_slope) / beta_[i + 1];
    previous = current;
    current = next;
    previous_slope = current_slope;
    current_slope = next_slope;
  }
  if (!slopes) return;
  slopes_.resize(degree + 1, degree + 1);
  for (int k = 0; k <= degree; ++k) {
    const Eigen::ArrayXd slope = slope_projector_.row(k).transpose().array() / weights;
    slopes_.col(k) = slope_projector_ * slope.matrix();
  }
}

Eigen::VectorXd TaperedBasis::sampled(const std::function<double(double)>& function, double radius) const {
  return nodes_.unaryExpr([&](double x) { return function(radius * x); });
}

Eigen::VectorXd TaperedBasis::project(const std::function<double(double)>& function, double radius) const {
  return projector_ * sampled(function, radius);
}

Eigen::VectorXd TaperedBasis::project_slope(const std::function<double(double)>& slope, double radius) const {
  return slope_projector_ * sampled(slope, radius);
}

std::shared_ptr<const TaperedBasis> tapered_basis(const RadialFunction& function, int degree) {
  const int dimensions = function.dimensions;
  const bool slopes = static_cast<bool>(function.slope);
  thread_local Memo<std::tuple<int, int, int, bool>, TaperedBasis, 2> known;
  return known.get({dimensions, function.taper, degree, slopes},
                   [&] { return TaperedBasis(dimensions, function.taper, degree, slopes); });
}

double TaperedBasis::polynomial(const Eigen::VectorXd& coefficients, double v) const {
  double previous = 0.0;
  double current = q0_;
  double sum = coefficients[0] * current;
  for (Eigen::Index k = 0; k + 1 < coefficients.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double next = ((v - alpha_[i]) * current - beta_[i] * previous) / beta_[i + 1];
    previous = current;
    current = next;
    sum += coefficients[k + 1] * current;
  }
  return sum;
}

// On the unit ball x = r / R is the place: the integral of a square is R^n times that over it, and that of a
// slope's square R^(n - 2) times that of the slope by x, R d/dr.
RadialFit::RadialFit(const RadialFunction& function, const TaperedBasis& basis, double radius)
    : basis_(basis),
      volume_(std::pow(radius, function.dimensions)),
      energy_(function.energy),
      values_(basis.project(function.value, radius)) {
  if (function.slope) {
    slope_share_ = std::pow(radius, function.dimensions - 2) / function.slope_energy;
    slopes_ = radius * basis.project_slope(function.slope, radius);
    return;
  }
  // Of orthonormal functions each adds its own energy.
  const Eigen::ArrayXd energies = values_.array().square() * volume_ / energy_;
  double left = 1.0;
  for (const double energy : energies) errors_.push_back(left -= energy);
}

Eigen::VectorXd RadialFit::coefficients(int degree) const {
  const Eigen::Index count = degree + 1;
  if (slope_share_ == 0.0) return values_.head(count);
  const double share = volume_ / energy_;
  Eigen::MatrixXd normal = slope_share_ * basis_.slopes().topLeftCorner(count, count);
  normal.diagonal().array() += share;
  return normal.ldlt().solve(share * values_.head(count) + slope_share_ * slopes_.head(count));
}

double RadialFit::value_error(const Eigen::VectorXd& c) const {
  const double captured = slope_share_ == 0.0 ? c.squaredNorm() : c.dot(2.0 * values_.head(c.size()) - c);
  return 1.0 - captured * volume_ / energy_;
}

double RadialFit::error(int degree) const {
  if (slope_share_ == 0.0) return errors_[static_cast<std::size_t>(degree)];
  const Eigen::VectorXd c = coefficients(degree);
  const Eigen::VectorXd slope = basis_.slopes().topLeftCorner(c.size(), c.size()) * c;
  return std::max(value_error(c), 1.0 - slope_share_ * c.dot(2.0 * slopes_.head(c.size()) - slope));
}

}  // namespace solidnoise
