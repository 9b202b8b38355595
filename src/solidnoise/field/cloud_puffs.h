#pragma once

#include <cstdint>
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

}  // namespace solidnoise
