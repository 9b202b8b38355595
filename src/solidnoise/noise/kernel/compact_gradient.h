#pragma once

#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {

// The relative RMS error, over space, of a compact kernel's gradient,
//   sqrt(integral |grad g - grad g_t|^2 / integral |grad g|^2).
template <int Dim>
double gradient_error(const IsotropicGaborKernel<Dim>& kernel, const CompactKernel& compact);

// The same of a kernel that is cut off at a radius.
template <int Dim>
double gradient_beyond(const IsotropicGaborKernel<Dim>& kernel, double radius);

// Of a Gaussian exp(-pi a^2 |x|^2) times a wave of that frequency and random phase, whose envelope is a
// product of one compact one per axis.
double gradient_error(double a, double frequency, int dimensions, const CompactKernel& envelope);

// Of one whose envelope is `gaussian`, the compact form of the radial Gaussian, in as many dimensions; on
// average over phases.
double gradient_error(double a, double frequency, const CompactKernel& gaussian);

// The cheapest compact_gaussian(), likewise, of which the errors of the values and of the gradient are at
// most `error`.
CompactKernel compact_gaussian_with_gradient(double a, double frequency, int dimensions, double error);

// The cheapest envelope (compact_envelope) of which the errors of the values and of the gradient are at most
// `error`. Throws std::invalid_argument for an error out of range.
CompactKernel compact_envelope_with_gradient(double a, double frequency, int dimensions, double error);

}  // namespace solidnoise
