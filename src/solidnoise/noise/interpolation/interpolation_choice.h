#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/interpolation/interpolation_error.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"

namespace solidnoise {

// The step and taps that reach farthest.
inline constexpr AxisStep kWidestStep{16, 8};

// The ways to interpolate one part of a noise on a lattice of which no other beats any both in cost and in
// error, the costliest and most exact one last.
template <int Dim>
class PartChoice {
 public:
  struct Option {
    std::array<AxisStep, Dim> axes{};  // steps of 1: directly
    double cost = 0.0;
    double squared_error = 0.0;  // the sum over the axes, each as if the field varied along it alone
  };

  // Of a part of this mean square amplitude, with errors up to `budget`. `along` each axis up to the
  // distances of the widest step; `step` in world units per axis.
  PartChoice(const WaveMixture<Dim>& waves, const std::array<AxisCovariance, Dim>& along, double power,
             const LatticeFrame<Dim>& frame, double budget, Quantity quantity);

  const std::vector<Option>& options() const { return options_; }

 private:
  std::vector<Option> options_;
};

// The cheapest choice for all parts whose squared errors add up to no more than the budget: an option's
// number for each part. All pay the same price in error.
template <int Dim>
std::vector<std::size_t> choose_within(const std::vector<PartChoice<Dim>>& parts, double budget);

}  // namespace solidnoise
