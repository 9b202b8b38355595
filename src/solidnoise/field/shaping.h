#pragma once

#include <algorithm>
#include <span>
#include <variant>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// 3 t^2 - 2 t^3 of t clamped to 0..1.
inline float smoothstep(float t) {
  const float s = std::clamp(t, 0.0f, 1.0f);
  return s * s * (3.0f - 2.0f * s);
}

// The noise itself, in one of three ranges.
struct RawShaping {
  enum class Range {
    raw,            // as it is: mean 0, variance 1
    signed_values,  // -1 to 1: a third of it, so that 3 sigma is the end; beyond it clamped
    unit,           // 0 to 1: the same, halved and about 1/2
  };
  Range range = Range::raw;
  bool normalize = false;  // mean 0 and variance 1 in the box itself, and not on average over all seeds

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

// A cumulus in the recipe's box: puffs piled on a flat base, their surface broken into lobes by |noise|. Each
// octave k of the recipe's noise (frequency F_k, amplitude gain^k) lowers creases into the surface along its
// zeros and leaves lobes, round on the outside, between them; a higher octave is weaker in the creases of a
// lower one. With the distance d to the surface, negative inside,
//   density = core(d) * edge(d), edge = smoothstep(-d / width), core rising with the depth.
// Lengths named "in wavelengths" are in units of 1 / frequency, the first octave's.
struct CloudShaping {
  int puffs = 22;      // large puffs that the cloud is piled from, before their buds; 1 to 1000
  double lobes = 0.3;  // depth of the first octave's lobes, in wavelengths; 0 to 2
  double base = 0.12;  // part of the lobes' depth that is left at the flat base; 0 to 1
  double edge = 0.06;  // width of the soft edge, in wavelengths; > 0
  double wisps = 0.6;  // how far thin edges are eroded, in edge widths; 0 to 4
  double core = 0.25;  // part of the density that comes with depth; 0: none, 1: all; 0 to 1
  double lean = 0.25;  // sideways shift of the top over its height, towards a random direction; 0 to 2

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const CloudShaping&, const CloudShaping&) = default;
};

// What becomes of the noise. One more look is one more alternative here.
using Shaping = std::variant<RawShaping, RemapShaping, VeinShaping, CloudShaping>;

// Maps values of a noise of unit variance to the range.
void to_range(RawShaping::Range range, std::span<float> values);

// What a shaping makes of a field that stands in the place of a noise of unit variance.

// The field in another range; RawShaping::Range::raw is the field itself.
FieldPtr shape(FieldPtr source, const RawShaping& shaping);

// The field is clamped to +-6, so that what is certainly empty is known. `box` in world units is where `edge`
// is measured.
FieldPtr shape(FieldPtr source, const RemapShaping& shaping, const Box<3>& box);

FieldPtr shape(FieldPtr source, const VeinShaping& shaping);

}  // namespace solidnoise
