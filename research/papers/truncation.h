#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/analysis/dense_field.h"

namespace solidnoise::papers {

// One noise summed three times over the same impulses: with the kernel as it is, with the kernel cut at the
// radius of a relative error, and with what was cut away (Lagae et al. 2011, figures 9 and 10).
struct TruncatedNoise {
  double radius = 0.0;  // of the cut kernel
  DenseField<2> whole;  // of a line one row
  DenseField<2> truncated;
  DenseField<2> difference;
  double noise_rms = 0.0;       // expected, eq. 16
  double error_rms = 0.0;       // measured
  double expected_rms = 0.0;    // eq. 22: the error times noise_rms
  double standard_error = 0.0;  // of error_rms, from the scatter of the parts of the field
};

struct TruncationOptions {
  double error = 0.25;      // relative
  double density = 0.0415;  // impulses per unit^Dim; weights uniform on [-1, 1]
  int side = 256;           // samples, one unit apart
  std::uint64_t seed = 1;
};

// The kernel is the paper's example (paper_kernel.h), with an amplitude for which the noise has unit
// variance. Dim is 1 or 2. Impulses as far as the kernel is above 1e-6 of its maximum are summed one by one,
// in double precision: this is the definition, not the library's evaluation.
template <int Dim>
TruncatedNoise truncate_noise(const TruncationOptions& options);

}  // namespace solidnoise::papers
