#pragma once

#include "solidnoise/core/field.h"
#include "solidnoise/noise/cellular/cellular_noise_options.h"

namespace solidnoise {

// Closed forms of the distances F1 and F2 from a place to the nearest and second nearest points of a Poisson
// process in Dim dimensions (1 to 4), one point per unit volume on average, and of F2 - F1.
//
// With V r^n the volume of a ball, the volumes v1 < v2 of the balls that end at the two points are the first
// two arrivals of a Poisson process on the line, v1 uniform below v2, so that
//   E F1^j F2^k = V^(-(j + k) / n) Gamma(2 + (j + k) / n) n / (n + j).
// Two places d apart have balls A and B of radii r and s, with B(r) and so on for volumes, and A has no point
// where F1 > r and one at most where F2 > r. For the mean products that leaves, integrated over r and s,
//   F1:       exp(-|A or B|)                                    less exp(-|A| - |B|)
//   F2 - F1:  exp(-|A or B|) (|A not B| |B not A| + |A and B|)  less exp(-|A| - |B|) |A| |B|
// which is the covariance. Its radial transform is the power spectrum, which falls as f^-(n + 3), for values
// have creases. Directions to the points are independent and uniform, and |grad F| = 1.
//
// Worley 1996 gives none of these; they are ours. Distances are Euclidean, in units of density^(-1/n).
template <int Dim>
class CellularStatistics {
 public:
  using Feature = CellularNoiseOptions::Feature;

  explicit CellularStatistics(Feature feature) : feature_(feature) {}

  double mean() const { return moment(1); }
  double variance() const;
  double excess_kurtosis() const;
  // Of each component of the gradient: 1/n of the mean square of its length, which is 1 or 2.
  double gradient_variance() const { return (feature_ == Feature::distance ? 1.0 : 2.0) / Dim; }

  // At places d >= 0 apart, within 1e-4 of the variance.
  double covariance(double d) const;
  // At f >= 0; its integral over all frequencies is the variance.
  double power_spectrum(double f) const;
  // That holds all but a thousandth of the variance.
  Band band() const;

 private:
  double moment(int power) const;

  Feature feature_;
};

}  // namespace solidnoise
