#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "reference/gabor_kernels.h"
#include "reference/gabor_reference.h"

namespace solidnoise::reference {

// Surface Gabor noise point by point, as the papers' programs go about it (2009, section 4, and 2011, figure
// 16): the 3^3 cells around a point each make their impulses; those nearer to its tangent plane than the
// radius, which is the side of a cell, are projected on it and weighted by 1 less their distance from it.
// Isotropic kernel.
template <typename Real = double>
class SurfaceGaborProcedure {
 public:
  using Kernel = IsotropicKernel<2, Real>;

  // `impulses`: mean number in the cylinder of that radius and twice its height.
  SurfaceGaborProcedure(const KernelParameters& parameters, double radius, double impulses,
                        std::uint32_t seed)
      : kernel_{parameters}, radius_(static_cast<Real>(radius)), seed_(seed) {
    const double mean_per_cell = impulses / (2.0 * std::numbers::pi);
    exp_minus_mean_ = static_cast<Real>(std::exp(-mean_per_cell));
    constexpr double kTent = 2.0 / 3.0;  // integral of (1 - |u|)^2
    const double energy =
        kTent * radius * integrate_over_ball<2>(radius, [&](double r) { return kernel_.mean_square(r); });
    amplitude_ = static_cast<Real>(1.0 / std::sqrt(mean_per_cell / std::pow(radius, 3) * energy));
  }

  Real operator()(const Position<3, Real>& point, const Position<3, Real>& normal) const {
    std::array<std::int32_t, 3> cell;
    Position<3, Real> fraction;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Real scaled = point[axis] / radius_;
      cell[axis] = static_cast<std::int32_t>(std::floor(scaled));
      fraction[axis] = scaled - std::floor(scaled);
    }
    Real sum = 0;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          sum += sum_of_cell({cell[0] + i, cell[1] + j, cell[2] + k},
                             {fraction[0] - static_cast<Real>(i), fraction[1] - static_cast<Real>(j),
                              fraction[2] - static_cast<Real>(k)},
                             normal);
        }
      }
    }
    return amplitude_ * sum;
  }

 private:
  Real sum_of_cell(const std::array<std::int32_t, 3>& cell, const Position<3, Real>& fraction,
                   const Position<3, Real>& normal) const {
    CellGenerator generator(cell, seed_);
    const int count = generator.next_poisson(exp_minus_mean_);
    Real sum = 0;
    for (int i = 0; i < count; ++i) {
      Real height = 0;
      Real squared_distance = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real offset = fraction[axis] - generator.template next<Real>();
        height += offset * normal[axis];
        squared_distance += offset * offset;
      }
      const auto mark = kernel_.draw(generator);
      const Real along = squared_distance - height * height;
      if (std::abs(height) >= 1 || along >= 1) continue;
      sum += (1 - std::abs(height)) * kernel_({}, along * radius_ * radius_, mark);
    }
    return sum;
  }

  Kernel kernel_;
  Real radius_;
  Real exp_minus_mean_;
  Real amplitude_;
  std::uint32_t seed_;
};

}  // namespace solidnoise::reference
