#pragma once

#include <vector>

#include "solidnoise/core/lattice.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// Appends the positions of a lattice's samples, in its order.
inline void append_positions(const Lattice<3>& lattice, std::vector<Vec<3>>& positions) {
  positions.reserve(positions.size() + lattice.size());
  for (int i = 0; i < lattice.count.x; ++i) {
    for (int j = 0; j < lattice.count.y; ++j) {
      for (int k = 0; k < lattice.count.z; ++k) {
        positions.emplace_back(lattice.coordinate(0, i), lattice.coordinate(1, j), lattice.coordinate(2, k));
      }
    }
  }
}

}  // namespace solidnoise
