#pragma once

#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/interpolation/axis_weights.h"

namespace solidnoise {

// What a lattice's samples are interpolated for.
enum class Quantity { values, gradient };

// The weights along each axis; those that make slopes for gradients only.
struct LatticeWeights {
  std::vector<AxisWeights> values;
  std::vector<AxisWeights> slopes;
};

// Mean square errors over all samples of a lattice: of the values, or of the gradient's length.
struct LatticeError {
  double interpolation = 0.0;
  // That of the kernels, which are compact, as it is in the values that come out: coarse lattices smooth it.
  // 0 for gradients.
  double truncation = 0.0;
};

// The errors of one part of a noise, of the separable weights, without approximation. Of a wave of variance v
// under an envelope, the error of the values is v (1 - 2 prod A_i + prod B_i), with A_i and B_i the means
// over an axis' phases of the weights' response and of its square (AxisWeights); that of the derivative along
// an axis has in that axis' place the mean square of the slope, and the responses of the weights for slopes.
// `step` in world units per axis.
template <int Dim>
LatticeError predict_error(const WaveMixture<Dim>& waves, const Vec<Dim>& step,
                           const LatticeWeights& weights);

}  // namespace solidnoise
