#pragma once

#include <variant>

#include "solidnoise/core/vec.h"
#include "solidnoise/volume/field/cloud_shaping.h"

namespace solidnoise {

// The noise itself, in one of three ranges.
struct RawShaping {
  enum class Range {
    raw,            // as it is: mean 0, variance 1
    signed_values,  // -1 to 1: a third of it, so that 3 sigma is the end; beyond it clamped
    unit,           // 0 to 1: the same, halved and about 1/2
  };
  Range range = Range::raw;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const RawShaping&, const RawShaping&) = default;
};

// A density from one noise n of unit variance, through a soft threshold that may rise toward the edge of the
// box:
//   density = floor + (1 - floor) smoothstep((fold(n) - threshold - edge s^2) / softness)^power,
// s = distance to the box's centre, 1 on the ellipsoid inscribed in the box. Where edge > 0, the density is 0
// outside of that ellipsoid at the latest, whatever the floor.
struct RemapShaping {
  enum class Fold {
    none,    // n
    ridged,  // -|n|: sheets along the noise's zeros
    billow,  // |n|: lobes between creases
  };
  Fold fold = Fold::none;
  double threshold = 0.0;  // where the density begins, in sigmas of the noise
  double softness = 1.0;   // over which it rises to its full value, in sigmas; > 0
  double power = 1.0;      // contrast; > 0
  double edge = 0.0;       // rise of the threshold from the box's centre to its sides, in sigmas; at least 0
  double floor = 0.0;      // density where there would be none; 0 to 1

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const RemapShaping&, const RemapShaping&) = default;
};

// Layers that a noise n of unit variance bends, Perlin's marble:
//   density = floor + (1 - floor) (1/2 + 1/2 cos(2 pi (p . direction / spacing + turbulence n)))^sharpness,
// p in world units.
struct VeinShaping {
  Vec<3> direction{1.0, 0.0, 0.0};  // across the veins; any length but 0
  double spacing = 0.5;             // from vein to vein, world units; > 0
  double turbulence = 0.5;          // shift by one sigma of the noise, in spacings; at least 0
  double sharpness = 4.0;           // above 1 thin dense veins, below 1 thin gaps in a dense body; > 0
  double floor = 0.0;               // density between veins; 0 to 1

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const VeinShaping&, const VeinShaping&) = default;
};

// What becomes of the noise. One more look is one more alternative here.
using Shaping = std::variant<RawShaping, RemapShaping, VeinShaping, CloudShaping>;

}  // namespace solidnoise
