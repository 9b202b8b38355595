#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "reference/gabor_kernels.h"

// Gabor noise point by point, for comparison with the library.
namespace solidnoise::reference {

// One impulse of a noise, as a caller may give it: what is not used may stay as it is.
template <int Dim>
struct Impulse {
  Position<Dim> position{};
  double weight = 1.0;
  Position<Dim> frequency{};  // of an oriented kernel's wave, cycles per world unit
  double phase = 0.0;         // in cycles
};

// Sparse convolution as it is defined: the sum of kernel(offset from the impulse, impulse) over all impulses.
template <int Dim, typename Kernel>
double sum_impulses(std::span<const Impulse<Dim>> impulses, const Position<Dim>& point,
                    const Kernel& kernel) {
  double sum = 0.0;
  for (const Impulse<Dim>& impulse : impulses) {
    Position<Dim> offset;
    for (int axis = 0; axis < Dim; ++axis) offset[axis] = point[axis] - impulse.position[axis];
    sum += kernel(offset, impulse);
  }
  return sum;
}

// Volume of the unit ball in n dimensions.
template <int Dim>
constexpr double kBall = std::array{0.0, 2.0, std::numbers::pi, 4.0 * std::numbers::pi / 3.0,
                                    std::numbers::pi* std::numbers::pi / 2.0}[Dim];

// Integral over the ball of a radial function, by Simpson's rule.
template <int Dim, typename Function>
double integrate_over_ball(double radius, const Function& function) {
  constexpr int kIntervals = 2000;
  const double step = radius / kIntervals;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double r = i * step;
    const double rule = (i == 0 || i == kIntervals) ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += rule * function(r) * std::pow(r, Dim - 1);
  }
  return kBall<Dim> * Dim * sum * step / 3.0;
}

// The papers' procedure (2009, section 4): the 3^n cells around a point each make their impulses, and those
// nearer than the radius, which is the side of a cell, are summed. Scaled to unit variance: density times the
// integral of the mean squared kernel (2009, section 3; Campbell). `Real` is double for tests; the papers'
// programs use float.
template <int Dim, template <int, typename> class Kernel, typename Real = double>
class GaborProcedure {
 public:
  // `impulses`: mean number within the radius of a point.
  GaborProcedure(const KernelParameters& parameters, double radius, double impulses, std::uint32_t seed)
      : kernel_{parameters}, radius_(static_cast<Real>(radius)), seed_(seed) {
    const double mean_per_cell = impulses / kBall<Dim>;
    exp_minus_mean_ = static_cast<Real>(std::exp(-mean_per_cell));
    const double energy = integrate_over_ball<Dim>(radius, [&](double r) { return kernel_.mean_square(r); });
    amplitude_ = static_cast<Real>(1.0 / std::sqrt(mean_per_cell / std::pow(radius, Dim) * energy));
  }

  Real operator()(const Position<Dim, Real>& point) const {
    std::array<std::int32_t, Dim> cell;
    Position<Dim, Real> fraction;
    for (int axis = 0; axis < Dim; ++axis) {
      const Real scaled = point[axis] / radius_;
      cell[axis] = static_cast<std::int32_t>(std::floor(scaled));
      fraction[axis] = scaled - std::floor(scaled);
    }
    return amplitude_ * sum_of_neighbours<0>(cell, fraction);
  }

 private:
  // Loops over the axes from `Axis` on; `fraction` is the point as seen from the cell.
  template <int Axis>
  Real sum_of_neighbours(const std::array<std::int32_t, Dim>& cell,
                         const Position<Dim, Real>& fraction) const {
    if constexpr (Axis == Dim) {
      return sum_of_cell(cell, fraction);
    } else {
      Real sum = 0;
      for (int step = -1; step <= 1; ++step) {
        auto neighbour = cell;
        auto seen_from_it = fraction;
        neighbour[Axis] += step;
        seen_from_it[Axis] -= static_cast<Real>(step);
        sum += sum_of_neighbours<Axis + 1>(neighbour, seen_from_it);
      }
      return sum;
    }
  }

  Real sum_of_cell(const std::array<std::int32_t, Dim>& cell, const Position<Dim, Real>& fraction) const {
    CellGenerator generator(cell, seed_);
    const int count = generator.next_poisson(exp_minus_mean_);
    Real sum = 0;
    for (int i = 0; i < count; ++i) {
      Position<Dim, Real> offset;
      Real squared_distance = 0;
      for (int axis = 0; axis < Dim; ++axis) {
        offset[axis] = fraction[axis] - generator.template next<Real>();
        squared_distance += offset[axis] * offset[axis];
      }
      const auto mark = kernel_.draw(generator);
      if (squared_distance >= 1) continue;
      for (Real& component : offset) component *= radius_;
      sum += kernel_(offset, squared_distance * radius_ * radius_, mark);
    }
    return sum;
  }

  Kernel<Dim, Real> kernel_;
  Real radius_;
  Real exp_minus_mean_;
  Real amplitude_;
  std::uint32_t seed_;
};

}  // namespace solidnoise::reference
