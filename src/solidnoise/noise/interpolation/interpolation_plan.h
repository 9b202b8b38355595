#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/interpolation/axis_weights.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The step and taps that reach farthest.
inline constexpr AxisStep kWidestStep{16, 8};

// How one part of a noise is evaluated on a lattice.
template <int Dim>
struct InterpolationPlan {
  std::array<AxisStep, Dim> axes{};
  LatticeError error;        // the part's amplitude included
  double nanoseconds = 0.0;  // of a sample; see noise_cost.h

  bool direct() const {
    return std::all_of(axes.begin(), axes.end(), [](const AxisStep& axis) { return axis == AxisStep{}; });
  }
};

// What the sum of impulses costs at a sample of a lattice, in nanoseconds on a processor with AVX-512; only
// ratios matter. Fitted to isotropic kernels in 3 dimensions: impulses cost the more, the fewer samples their
// kernel covers.
template <int Dim>
double sum_nanoseconds(const WaveMixture<Dim>& waves, const Vec<Dim>& step);

// A part of a noise as plans see it.
template <int Dim>
struct NoisePart {
  WaveMixture<Dim> waves;
  std::array<AxisCovariance, Dim> along;  // each axis, at multiples of a lattice's step
  double power = 1.0;                     // squared amplitude
};

// The parts of a noise, or the noise itself where it has none, with so many distances along each axis.
template <int Dim>
std::vector<NoisePart<Dim>> parts_on_lattice(const Noise<Dim>& noise, const Vec<Dim>& step, int distances);

// The mean square error that all parts together may have; of two distances or more.
template <int Dim>
double squared_budget(const std::vector<NoisePart<Dim>>& parts, double error, Quantity quantity);

// Chooses for each part of a noise, or for the noise itself where it has no parts, on which multiple of a
// lattice's steps (world units per axis) it is evaluated, and from how many samples the rest is interpolated:
// the cheapest whose mean square errors together stay within (error * standard deviation)^2. The budget is
// not split evenly: all parts pay the same price in time for the last bit of accuracy, so that low octaves,
// which need few samples however accurate they are, leave it to the high ones.
//
// The error is in closed form (predict_error). It is the mean over all phases of the lattice, as the error
// that is measured over a volume is, and as that of the kernel is a mean over space. The phase farthest from
// all samples has up to sqrt(2) times as much where one sample of two is interpolated along each axis, and
// less else.
//
// Nor may the differences of neighbouring samples, which shading and surfaces follow, be wrong by more than 5
// times the error, relative to their own root mean square: where waves are long they are small, and weights
// that change from one coarse sample to the next would show as lines. Errors of neighbours are taken as
// independent; they are alike, and what is measured is a third of that.
//
// A gradient has a budget and a plan of its own: its error is relative to the root mean square of its length,
// and it is made from the noise's values, by weights for slopes.
//
// Steps divide the lattice's periods, so that the same samples are interpolated after one.
//
// What is not stationary is evaluated directly: a plan of steps 1, without error.
template <int Dim>
class InterpolationPlanner {
 public:
  InterpolationPlanner(const Noise<Dim>& noise, const LatticeFrame<Dim>& frame);

  // A plan for each part.
  std::vector<InterpolationPlan<Dim>> plan(double error, Quantity quantity = Quantity::values) const;

  // The weights of a part's plan.
  LatticeWeights weights(std::size_t part, const InterpolationPlan<Dim>& plan, Quantity quantity) const;

 private:
  LatticeError error_of(std::size_t part, const InterpolationPlan<Dim>& plan, Quantity quantity) const;

  LatticeFrame<Dim> frame_;
  std::vector<NoisePart<Dim>> parts_;
};

}  // namespace solidnoise
