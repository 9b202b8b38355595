#include "solidnoise/noise/convolution/kernel_cells.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace solidnoise {
namespace {

template <int Dim>
std::array<CellAxis, Dim> make_cells(double side, double radius, const Vec<4>& period) {
  constexpr std::array<const char*, 4> kAxisNames = {"x", "y", "z", "t"};
  std::array<CellAxis, Dim> axes;
  for (int axis = 0; axis < Dim; ++axis) {
    double size = side;
    std::int64_t period_cells = 0;
    if (period[axis] > 0.0) {
      if (period[axis] < 2.0 * radius) {
        throw std::invalid_argument(fmt::format(
            "period is {} along {}; it must be at least {:.6g} (twice the kernel's radius), or 0 for none",
            period[axis], kAxisNames[axis], 2.0 * radius));
      }
      const double most = CellAxis::kMostCells * side;
      if (period[axis] > most) {
        throw std::invalid_argument(fmt::format(
            "period is {} along {}; it must be at most {:.6g} (2^40 of the cells that impulses are in)",
            period[axis], kAxisNames[axis], most));
      }
      period_cells = std::max<std::int64_t>(1, std::llround(period[axis] / side));
      size = period[axis] / static_cast<double>(period_cells);
    }
    axes[axis] = CellAxis(size, period_cells);
  }
  return axes;
}

template <int Dim>
double volume_of(const std::array<CellAxis, Dim>& axes) {
  double volume = 1.0;
  for (const CellAxis& axis : axes) volume *= axis.size();
  return volume;
}

}  // namespace

template <int Dim>
ImpulseLayout<Dim> make_layout(const StrataChoice& choice, double density, ImpulseSpread spread,
                               double radius, const Vec<4>& period) {
  if (spread == ImpulseSpread::poisson) {
    const double wanted = density > 0.0 ? density : choice.poisson_density();
    const auto axes = make_cells<Dim>(choice.radius, radius, period);
    return {axes, {wanted * volume_of<Dim>(axes), false}, wanted};
  }
  const Strata strata = density > 0.0 ? choice.of_density(density) : choice.fewest();
  const int halvings = choice.halvings(strata);
  const auto axes = make_cells<Dim>(std::ldexp(strata.side, halvings), radius, period);
  const double count = std::ldexp(strata.count, Dim * halvings);
  return {axes, {count, true, halvings, strata.mirrored}, count / volume_of<Dim>(axes)};
}

RadialPolynomial to_single_precision(const CompactKernel& kernel, int most_degree) {
  const auto single = [](std::span<const double> from) {
    return std::vector<float>(from.begin(), from.end());
  };
  RadialPolynomial polynomial;
  polynomial.power = kernel.well_conditioned() && kernel.degree() <= most_degree;
  if (polynomial.power) {
    const int even = std::max(2, (kernel.degree() + 1) / 2 * 2);
    polynomial.value = single(kernel.power_coefficients());
    polynomial.slope = single(kernel.power_slope());
    for (auto* const each : {&polynomial.value, &polynomial.slope}) {
      each->resize(static_cast<std::size_t>(even) + 1, 0.0f);
    }
  } else {
    polynomial.value = single(kernel.chebyshev_coefficients());
    polynomial.slope = single(kernel.chebyshev_slope());
  }
  return polynomial;
}

template ImpulseLayout<1> make_layout<1>(const StrataChoice&, double, ImpulseSpread, double, const Vec<4>&);
template ImpulseLayout<2> make_layout<2>(const StrataChoice&, double, ImpulseSpread, double, const Vec<4>&);
template ImpulseLayout<3> make_layout<3>(const StrataChoice&, double, ImpulseSpread, double, const Vec<4>&);
template ImpulseLayout<4> make_layout<4>(const StrataChoice&, double, ImpulseSpread, double, const Vec<4>&);

}  // namespace solidnoise
