#include "solidnoise/noise/convolution/kernel_cells.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace solidnoise {
namespace {

// Horner's rule is compiled for these degrees.
constexpr int kLowestHornerDegree = 2;
constexpr int kHighestHornerDegree = 12;

std::vector<double> power_derivative(std::span<const double> coefficients) {
  std::vector<double> derivative;
  for (std::size_t k = 1; k < coefficients.size(); ++k) {
    derivative.push_back(static_cast<double>(k) * coefficients[k]);
  }
  return derivative;
}

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

std::vector<float> padded(std::span<const double> coefficients, std::size_t size) {
  std::vector<float> single(size, 0.0f);
  for (std::size_t k = 0; k < coefficients.size(); ++k) single[k] = static_cast<float>(coefficients[k]);
  return single;
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
      period_cells = static_cast<std::int64_t>(std::floor(period[axis] / radius));
      size = period[axis] / static_cast<double>(period_cells);
    }
    cells.axes[axis] = CellAxis(size, period_cells);
    cells.radius[axis] = radius / size;
    cells.volume *= size;
  }
  return cells;
}

RadialPolynomial to_single_precision(const CompactKernel& kernel) {
  RadialPolynomial polynomial;
  if (kernel.well_conditioned() && kernel.degree() <= kHighestHornerDegree) {
    polynomial.basis = RadialPolynomial::Basis::power;
    int degree = std::max(kernel.degree(), kLowestHornerDegree);
    degree += degree % 2;
    const auto size = static_cast<std::size_t>(degree) + 1;
    polynomial.value = padded(kernel.power_coefficients(), size);
    polynomial.derivative = padded(power_derivative(kernel.power_coefficients()), size);
  } else {
    polynomial.basis = RadialPolynomial::Basis::chebyshev;
    const auto size = kernel.chebyshev_coefficients().size();
    polynomial.value = padded(kernel.chebyshev_coefficients(), size);
    polynomial.derivative = padded(chebyshev_derivative(kernel.chebyshev_coefficients()), size);
  }
  return polynomial;
}

template KernelCells<1> make_kernel_cells<1>(double, const Vec<4>&);
template KernelCells<2> make_kernel_cells<2>(double, const Vec<4>&);
template KernelCells<3> make_kernel_cells<3>(double, const Vec<4>&);
template KernelCells<4> make_kernel_cells<4>(double, const Vec<4>&);

}  // namespace solidnoise
