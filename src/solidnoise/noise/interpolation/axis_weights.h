#pragma once

#include <span>
#include <vector>

namespace solidnoise {

// How one axis of a lattice is interpolated: from every `step`-th sample, `taps` of them for each sample.
struct AxisStep {
  int step = 1;  // 1: not at all
  int taps = 1;  // even, where the step is above 1

  friend bool operator==(const AxisStep&, const AxisStep&) = default;
};

// The weights of linear interpolation along one axis that are best for a stationary field: of sample i, which
// lies at the phase p = i mod step between coarse samples, they minimise the mean square error
//   E (n(i) - sum over t of w_p[t] n(step (floor(i / step) - taps / 2 + 1 + t)))^2,
// that is, they solve the normal equations in the field's own covariance (simple kriging, Wiener's
// interpolation). At phase 0 they are 1 and 0: coarse samples stay as they are.
class AxisWeights {
 public:
  // `covariance` of the field at distances 0, 1, 2, ... samples, up to step * taps of them.
  AxisWeights(AxisStep shape, std::span<const double> covariance);

  const AxisStep& shape() const { return shape_; }
  std::span<const double> of_phase(int phase) const {
    return std::span(weights_).subspan(static_cast<std::size_t>(phase * shape_.taps),
                                       static_cast<std::size_t>(shape_.taps));
  }

  // Mean square error, over all phases, of a field of this covariance (as the constructor's) that varies
  // along this axis alone.
  double squared_error(std::span<const double> covariance) const;

  // What interpolation makes of a wave cos(k t) of sample k under an envelope: with H_p the response at phase
  // p, relative to the wave, the means over the phases of H_p, which is real, and of |H_p|^2.
  struct Response {
    double mean = 1.0;
    double mean_square = 1.0;
  };
  // `cosine` of t; `envelope` at distances as the constructor's covariance, empty for 1.
  Response response(double cosine, std::span<const double> envelope) const;

  // The mean over the phases of the sum of squared weights: the response to white noise.
  double white_response() const { return autocorrelation_[0]; }

 private:
  AxisStep shape_;
  std::vector<double> weights_;          // phase by phase
  std::vector<double> by_distance_;      // mean weight at the distance of so many samples, to either side
  std::vector<double> autocorrelation_;  // mean over the phases of sum over t of w[t] w[t + k]
};

}  // namespace solidnoise
