#pragma once

#include <array>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/interpolation/axis_weights.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// How one part of a noise is evaluated on a lattice.
template <int Dim>
struct InterpolationPlan {
  std::array<AxisStep, Dim> axes{};
  // Mean square error of the interpolation over all samples of the lattice, the part's amplitude included.
  double squared_error = 0.0;
  // That of the kernels, which are compact, as it is in the result: coarse lattices smooth it.
  double truncation = 0.0;

  bool direct() const {
    for (const AxisStep& axis : axes) {
      if (axis.step > 1) return false;
    }
    return true;
  }
};

// Chooses for each part of a noise, or for the noise itself where it has no parts, on which multiple of a
// lattice's steps (world units per axis) it is evaluated, and from how many samples the rest is interpolated:
// the cheapest whose mean square errors together stay within (error * standard deviation)^2. The budget is
// not split evenly: all parts pay the same price in time for the last bit of accuracy, so that low octaves,
// which need few samples however accurate they are, leave it to the high ones.
//
// The error is in closed form, for the separable weights that are used: of a wave w under an envelope
// (WaveMixture) it is v (1 - 2 prod A_i + prod B_i), with A_i and B_i the means over an axis' phases of the
// response and of its square. It is the mean over all phases of the lattice, as the error that is measured
// over a volume is, and as that of the kernel is a mean over space. The phase farthest from all samples has
// up to sqrt(2) times as much where one sample of two is interpolated along each axis, and less else.
//
// Nor may the differences of neighbouring samples, which shading and surfaces follow, be wrong by more than 5
// times the error, relative to their own root mean square: where waves are long they are small, and weights
// that change from one coarse sample to the next would show as lines. Errors of neighbours are taken as
// independent; they are alike, and what is measured is a third of that.
//
// What is not stationary is evaluated directly: a plan of steps 1, without error.
template <int Dim>
std::vector<InterpolationPlan<Dim>> plan_interpolation(const Noise<Dim>& noise, const Vec<Dim>& step,
                                                       double error);

// The weights along each axis of a part's plan.
template <int Dim>
std::vector<AxisWeights> interpolation_weights(const WaveMixture<Dim>& waves, const Vec<Dim>& step,
                                               const InterpolationPlan<Dim>& plan);

}  // namespace solidnoise
