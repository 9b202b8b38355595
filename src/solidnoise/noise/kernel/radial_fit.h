#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {

// What is to be approximated: a radial function in n dimensions.
struct RadialFunction {
  int dimensions;
  std::function<double(double)> value;  // of r
  double energy;                        // integral of its square over space
  double tail_radius;                   // where cutting it off alone reaches the wanted error
  double frequency;                     // that of its oscillation along r; 0 for none
  std::function<double(double)> slope;  // its derivative by r, where that is approximated too
  double slope_energy = 0.0;            // integral of the slope's square over space
  int taper = kRadialTaper;             // of what approximates it
};

// The functions t^m q_k(v), m the taper, k = 0 to some degree, orthonormal over the unit ball of n
// dimensions, sampled at the nodes of a quadrature in r. Over the ball, t^(2 m) r^(n-1) dr is proportional to
// (1 - u)^(n/2 - 1) (1 + u)^(2 m) du with u = 2 v: the q_k are Jacobi polynomials of u. Coefficients of a
// projection on them do not depend on how many there are, so that one projection gives the error of every
// degree.
class TaperedBasis {
 public:
  // With `slopes`, the functions' derivatives by r as well.
  TaperedBasis(int dimensions, int taper, int degree, bool slopes);

  int degree() const { return static_cast<int>(projector_.rows()) - 1; }

  // Integrals over the unit ball of each function times x -> function(radius x), and of the slopes.
  Eigen::VectorXd project(const std::function<double(double)>& function, double radius) const;
  Eigen::VectorXd project_slope(const std::function<double(double)>& slope, double radius) const;
  // Those of the slopes' products.
  const Eigen::MatrixXd& slopes() const { return slopes_; }

  // Sum of c_k q_k(v).
  double polynomial(const Eigen::VectorXd& coefficients, double v) const;

 private:
  Eigen::VectorXd sampled(const std::function<double(double)>& function, double radius) const;

  Eigen::VectorXd nodes_;            // r, in ]0, 1[
  Eigen::MatrixXd projector_;        // row k: weight t^m q_k at each node
  Eigen::MatrixXd slope_projector_;  // and weight d(t^m q_k)/dr
  Eigen::MatrixXd slopes_;
  std::vector<double> alpha_;  // v q_k = beta_(k+1) q_(k+1) + alpha_k q_k + beta_k q_(k-1)
  std::vector<double> beta_;
  double q0_ = 1.0;
};

// The same serves all kernels of a degree, such as those of octaves.
std::shared_ptr<const TaperedBasis> tapered_basis(const RadialFunction& function, int degree);

// The best sums of the functions of a basis on a ball, of each degree. Where slopes are approximated, too,
// the squared errors of both count, each relative to its own energy:
//   integral (g - g_t)^2 / integral g^2  +  integral |grad g - grad g_t|^2 / integral |grad g|^2
// is the least.
class RadialFit {
 public:
  RadialFit(const RadialFunction& function, const TaperedBasis& basis, double radius);

  Eigen::VectorXd coefficients(int degree) const;
  // Squared and relative: of the values, and the larger one of these and the slopes.
  double value_error(const Eigen::VectorXd& coefficients) const;
  double error(int degree) const;

 private:
  const TaperedBasis& basis_;
  double volume_;  // R^n
  double energy_;
  double slope_share_ = 0.0;  // of the function's slope energy, that the unit ball's is; 0: no slopes
  Eigen::VectorXd values_;
  Eigen::VectorXd slopes_;
  std::vector<double> errors_;  // of each degree, without slopes
};

}  // namespace solidnoise
