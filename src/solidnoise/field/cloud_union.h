#pragma once

#include <array>
#include <span>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/field/cloud_puffs.h"

namespace solidnoise {

// The smooth union of puffs, as a signed distance d in world units, negative inside:
//   d = d_0 - k log(sum_i w((d_i - d_0) / k)),  w(x) = max(0, 1 - x / 3)^3,  d_0 = min_i d_i,
// d_i the distance to puff i. This is the exponential smooth minimum with exp(-x) replaced by a function that
// ends at x = 3: puffs that are farther than the nearest one by 3 k do not matter at all, and can be left out
// without changing a bit.
class PuffUnion {
 public:
  // `rounding` is k, world units; > 0.
  PuffUnion(std::vector<Puff> puffs, double rounding);

  const std::vector<Puff>& puffs() const { return puffs_; }

  // A lower bound of the distance within the box; not the tightest.
  double lower_bound(const Box<3>& box) const;

  // The puffs that matter within the box, in their order.
  PuffUnion within(const Box<3>& box) const;

  // The distances at x[i], y[i], z[i].
  void evaluate(const std::array<std::span<const float>, 3>& positions, std::span<float> distances) const;

 private:
  std::vector<Puff> puffs_;
  double rounding_;
};

}  // namespace solidnoise
