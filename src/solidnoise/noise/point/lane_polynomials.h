#pragma once

#include <span>
#include <vector>

#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/noise/point/point_cluster.h"

namespace solidnoise {

// The polynomials of a cluster's kernels, side by side as the sums take them.
class LanePolynomials {
 public:
  using Kernels = std::span<const KernelFamily::Member* const>;

  // Those of 1 to 16 kernels; further lanes repeat the last. All in powers of v, or all in Chebyshev
  // polynomials. Valid until the next call. A lane's value does not depend on the degree of the others: to
  // higher coefficients of 0 both rules of summation give nothing.
  const PointPolynomials& fill(Kernels kernels, bool power);

 private:
  void fill_lane(const KernelFamily::Member& kernel, std::size_t lane);

  std::vector<float> memory_;
  float* coefficients_ = nullptr;  // in memory_, aligned
  PointPolynomials polynomials_;
  KernelFamily::Member filled_;  // that all lanes are of; none if they differ
};

}  // namespace solidnoise
