#include "solidnoise/noise/convolution/kernel_cells.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/noise/kernel/factored_polynomial.h"

namespace solidnoise {
namespace {

// d/dv of a Chebyshev series in u = 2 v: d'_{k-1} = d'_{k+1} + 2 k c_k for d/du, then doubled.
std::vector<double> chebyshev_derivative(std::span<const double> coefficients) {
  const int degree = static_cast<int>(coefficients.size()) - 1;
  std::vector<double> derivative(coefficients.size() + 1, 0.0);
  for (int k = degree; k >= 1; --k) derivative[k - 1] = derivative[k + 1] + 2.0 * k * coefficients[k];
  derivative[0] *= 0.5;
  derivative.resize(coefficients.size());
  for (double& value : derivative) value *= 2.0;
  return derivative;
}

// The factored form of the kernel's polynomial, if it is one that is compiled, and accurate enough.
std::optional<FactoredPolynomial> factored(const CompactKernel& kernel, const FactoredLimits& limits) {
  if (kernel.degree() < 1 || kernel.degree() > limits.degree) return std::nullopt;
  // Of such a leading coefficient nothing is left in single precision: there is no use in its roots.
  if (std::abs(kernel.chebyshev_coefficients().back()) < 1e-9 * std::abs(kernel.value(0.0)))
    return std::nullopt;
  const FactoredPolynomial polynomial(kernel.chebyshev_coefficients());
  const double rounding = kernel.rounding_error(
      [&](float t) { return static_cast<float>(polynomial.leading()) * polynomial.monic(t); });
  const bool accurate = rounding <= std::fmin(limits.rounding, 0.01 * kernel.relative_error());
  return accurate ? std::optional(polynomial) : std::nullopt;
}

}  // namespace

template <int Dim>
KernelCells<Dim> make_kernel_cells(double radius, const Vec<4>& period) {
  constexpr std::array<const char*, 4> kAxisNames = {"x", "y", "z", "t"};
  KernelCells<Dim> cells;
  for (int axis = 0; axis < Dim; ++axis) {
    double size = radius;
    std::int64_t period_cells = 0;
    if (period[axis] > 0.0) {
      if (period[axis] < 2.0 * radius) {
        throw std::invalid_argument(fmt::format(
            "period is {} along {}; it must be at least {:.6g} (twice the kernel's radius), or 0 for none",
            period[axis], kAxisNames[axis], 2.0 * radius));
      }
      const double most = CellAxis::kMostCells * radius;
      if (period[axis] > most) {
        throw std::invalid_argument(
            fmt::format("period is {} along {}; it must be at most {:.6g} (2^40 of the kernel's radius)",
                        period[axis], kAxisNames[axis], most));
      }
      period_cells = static_cast<std::int64_t>(std::floor(period[axis] / radius));
      size = period[axis] / static_cast<double>(period_cells);
    }
    cells.axes[axis] = CellAxis(size, period_cells);
    cells.radius[axis] = radius / size;
    cells.volume *= size;
  }
  return cells;
}

RadialPolynomial to_single_precision(const CompactKernel& kernel, const FactoredLimits& limits) {
  RadialPolynomial polynomial;
  if (const auto product = factored(kernel, limits)) {
    polynomial.form = RadialPolynomial::Form::factored;
    polynomial.leading = static_cast<float>(product->leading());
    polynomial.value.assign(product->coefficients().begin(), product->coefficients().end());
  } else {
    const auto single = [](std::span<const double> from) {
      return std::vector<float>(from.begin(), from.end());
    };
    polynomial.form = RadialPolynomial::Form::chebyshev;
    polynomial.value = single(kernel.chebyshev_coefficients());
    polynomial.derivative = single(chebyshev_derivative(kernel.chebyshev_coefficients()));
  }
  return polynomial;
}

template KernelCells<1> make_kernel_cells<1>(double, const Vec<4>&);
template KernelCells<2> make_kernel_cells<2>(double, const Vec<4>&);
template KernelCells<3> make_kernel_cells<3>(double, const Vec<4>&);
template KernelCells<4> make_kernel_cells<4>(double, const Vec<4>&);

}  // namespace solidnoise
