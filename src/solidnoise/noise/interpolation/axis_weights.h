#pragma once

#include <span>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/wave_mixture.h"

namespace solidnoise {

// How one axis of a lattice is interpolated: from every `step`-th sample, `taps` of them for each sample.
struct AxisStep {
  int step = 1;  // 1: not at all
  int taps = 1;  // even, where the step is above 1

  // Distances of samples that weights reach over, 0 among them.
  int distances() const { return step * taps + 1; }

  friend bool operator==(const AxisStep&, const AxisStep&) = default;
};

// The weights of linear interpolation along one axis that are best for a stationary field: of sample i, which
// lies at the phase p = i mod step between coarse samples, they minimise the mean square error
//   E (n(i) - sum over t of w_p[t] n(step (floor(i / step) - taps / 2 + 1 + t)))^2,
// that is, they solve the normal equations in the field's own covariance (simple kriging, Wiener's
// interpolation). At phase 0 they are 1 and 0: coarse samples stay as they are. Or, in the same way, the
// weights that make the field's derivative along the axis, per world unit, from its values.
class AxisWeights {
 public:
  enum class Of { values, slopes };

  // `covariance` at the shape's distances, at least. Slopes need taps: steps of 1 are for values.
  AxisWeights(AxisStep shape, const AxisCovariance& covariance, Of of = Of::values);

  const AxisStep& shape() const { return shape_; }
  std::span<const double> of_phase(int phase) const {
    return std::span(weights_).subspan(static_cast<std::size_t>(phase * shape_.taps),
                                       static_cast<std::size_t>(shape_.taps));
  }

  // Means over the phases: of the product of what is wanted and what the weights make of a field, and of the
  // square of the latter. The mean square error is the variance of what is wanted - 2 product + square.
  struct Response {
    double product = 1.0;
    double square = 1.0;
  };
  // At the shape's distances: the field's covariance, and its covariance with what is wanted, which is the
  // same for values.
  Response response(std::span<const double> covariance, std::span<const double> wanted) const;

  // The mean square error of values that are interpolated, of a field that varies along this axis alone.
  double squared_error(std::span<const double> covariance) const;

  // The mean over the phases of the sum of squared weights: the response to white noise.
  double white_response() const { return autocorrelation_[0]; }

 private:
  AxisStep shape_;
  std::vector<double> weights_;          // phase by phase
  std::vector<double> by_distance_;      // mean weight at the distance of so many samples, to either side
  std::vector<double> autocorrelation_;  // mean over the phases of sum over t of w[t] w[t + k]
};

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
