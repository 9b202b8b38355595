#pragma once

namespace solidnoise {

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

}  // namespace solidnoise
