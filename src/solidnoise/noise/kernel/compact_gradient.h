#pragma once

#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {

// Compact kernels are the best ones for values. What they lack is of high frequencies, which count more in
// the gradient: its relative RMS error over space,
//   sqrt(integral |grad g - grad g_t|^2 / integral |grad g|^2),
// is one to three times that of the values. Both are as small as asked for where the values' is smaller.

template <int Dim>
double gradient_error(const IsotropicGaborKernel<Dim>& kernel, const CompactKernel& compact);

// Of a Gaussian exp(-pi a^2 |x|^2) times a wave of that frequency and random phase, whose envelope is a
// product of one compact one per axis.
double gradient_error(double a, double frequency, int dimensions, const CompactKernel& envelope);

// The cheapest kernel, and the cheapest envelope (compact_envelope), of which both errors are at most
// `error`. Throws std::invalid_argument for an error out of range.
template <int Dim>
CompactKernel compact_with_gradient(const IsotropicGaborKernel<Dim>& kernel, double error);
CompactKernel compact_with_gradient(double a, double frequency, int dimensions, double error);

}  // namespace solidnoise
