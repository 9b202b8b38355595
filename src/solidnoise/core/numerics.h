#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace solidnoise {

inline constexpr double kPi = std::numbers::pi;

inline double squared(double x) {
  return x * x;
}

// Nodes and weights on [-1, 1].
struct QuadratureRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

// The Gauss-Legendre rule of `count` >= 1 nodes: exact for polynomials of degree 2 count - 1.
QuadratureRule gauss_legendre(int count);

// Nodes of each panel of integrate().
inline constexpr int kPanelNodes = 20;

// The Gauss-Legendre rule of kPanelNodes nodes, computed once.
const QuadratureRule& panel_rule();

// Integral of a smooth function over [lower, upper], cut into equal panels. With two cycles or fewer of an
// oscillating integrand in each panel, the relative error is about 1e-14 of the integral of the absolute
// value.
template <typename Function>
double integrate(const Function& function, double lower, double upper, int panels = 1) {
  const QuadratureRule& rule = panel_rule();
  const double half_width = 0.5 * (upper - lower) / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = lower + half_width * (2 * panel + 1);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      sum += rule.weights[i] * function(middle + half_width * rule.nodes[i]);
    }
  }
  return sum * half_width;
}

// The x in [lower, upper] where a monotone function changes sign, to the last bits of double precision
// (relative to the larger end). Precondition: the function has different signs at the ends, or is 0 at one.
template <typename Function>
double bisect(const Function& function, double lower, double upper) {
  const bool negative_below = function(lower) < 0.0;
  const double resolution = 1e-15 * std::fmax(std::abs(lower), std::abs(upper));
  while (upper - lower > resolution) {
    const double middle = 0.5 * (lower + upper);
    if (middle == lower || middle == upper) break;
    ((function(middle) < 0.0) == negative_below ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

}  // namespace solidnoise
