#include "solidnoise/core/numerics.h"

#include <cmath>
#include <numbers>

namespace solidnoise {

QuadratureRule gauss_legendre(int count) {
  QuadratureRule rule;
  rule.nodes.resize(static_cast<std::size_t>(count));
  rule.weights.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    // Newton's method on the Legendre polynomial, from Tricomi's approximation of its zero.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 10; ++step) {
      double previous = 1.0;
      double value = x;
      for (int k = 2; k <= count; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      slope = count * (x * value - previous) / (x * x - 1.0);
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    const auto mirrored = static_cast<std::size_t>(count - 1 - i);
    rule.nodes[mirrored] = x;
    rule.weights[mirrored] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

const QuadratureRule& panel_rule() {
  static const QuadratureRule rule = gauss_legendre(kPanelNodes);
  return rule;
}

}  // namespace solidnoise
