#pragma once

#include <cstdint>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Parameters of cellular noise (Worley 1996).
struct CellularNoiseOptions {
  enum class Feature {
    distance,  // to the nearest point: 0 at the points, highest where cells meet
    border,    // the second nearest point's distance less the nearest's: 0 where two cells meet
  };

  double frequency = 8.0;  // cells per world unit along a line: frequency^Dim points per unit volume; > 0
  Feature feature = Feature::distance;
  std::uint64_t seed = 0;
  Vec<4> period{0.0};  // world units per axis (x, y, z, t); 0: none

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const CellularNoiseOptions&, const CellularNoiseOptions&) = default;
};

}  // namespace solidnoise
