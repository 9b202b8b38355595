#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// A ball of cloud, in the cloud's own frame: y is up, the base is at y = 0, and the middle of the ground
// below the cloud is the origin.
struct Puff {
  Vec<3> centre{0.0};
  double radius = 0.0;
};

// What a pile of puffs has to fit into, and how it is to look.
struct PuffPile {
  Vec<3> size{2.0, 1.0, 1.5};  // the box, world units; > 0; the pile stands on the middle of its floor
  int count = 22;              // large puffs; at least 1
  double lean = 0.25;          // sideways shift of the top over its height, in a random direction; at least 0
  std::uint64_t seed = 0;
};

// Puffs piled at random under a few towers of different heights, each overlapping another, and small buds on
// the outside of large ones. Above the floor all of it is in the box, and some of it touches the box's sides
// or its top. Puffs reach below the floor, where the cloud is to be cut.
std::vector<Puff> pile_puffs(const PuffPile& pile);

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
