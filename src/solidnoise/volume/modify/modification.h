#pragma once

#include <optional>
#include <type_traits>

#include "solidnoise/volume/vdb/grid_file.h"

namespace solidnoise {

// How a noise n and a value v of a grid become one. `amount` is a; fog volumes are kept from going under 0.
enum class Combine {
  replace,   // n, a density scaled as without a grid
  add,       // v + a n
  multiply,  // v (1 + a n)
  // v - a m (peak - v), at least 0: m in 0..1 is the noise (0 at -3 sigma, 1 at 3 sigma), peak the grid's
  // largest value. What is dense loses nothing, what is thin the more; values stay in 0..v. The remapping of
  // densities by Schneider 2015, without its division.
  erode,
};

inline constexpr Choices<Combine, 4> kCombineChoices{{
    {Combine::replace, "replace"},
    {Combine::add, "add"},
    {Combine::multiply, "multiply"},
    {Combine::erode, "erode"},
}};

// What is done to a grid that exists, instead of making one. Where the mask's value at a voxel is k, the
// result is v + k (result - v), or the surface moves by k of its way.
struct Modification {
  GridFile on;                          // a grid of floats; no file: none is chosen yet
  Combine combine = Combine::multiply;  // values; not of a level set
  double amount = 0.5;                  // of the noise; any number, not under 0 to erode
  std::optional<double> displace;       // instead, of a level set: how far one sigma moves it, world units
  std::optional<GridFile> mask;         // limits it; see GridMask
  std::optional<GridFile> rest;         // where the noise is looked up; see RestPositions

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const Modification&, const Modification&) = default;
};

constexpr auto fields_of(std::type_identity<Modification>) {
  return list_fields(
      field("on", &Modification::on,
            "Work on the active voxels of this grid, in place of one of the recipe's own; all else in its "
            "file is "
            "kept")
          .written_if([](const Modification& change) { return !change.on.file.empty(); }),
      field("displace", &Modification::displace, kFinite, "world units",
            "Of a level set, in place of combine and amount: how far one sigma moves its surface along its "
            "normals"),
      field("combine", &Modification::combine, kCombineChoices,
            "How the noise n, by the amount a, changes the value v: n in its place; v + a n; v (1 + a n); or "
            "thin parts worn off")
          .in_place_of("displace")
          .written_if([](const Modification& change) { return !change.displace; }),
      field("amount", &Modification::amount, kFinite, "",
            "How much of the noise: a in what combine says; to erode, 0 or more")
          .in_place_of("displace")
          .written_if([](const Modification& change) {
            return !change.displace && change.combine != Combine::replace;
          }),
      field("mask", &Modification::mask,
            "Limits the change to where this is over 0 (floats, level set, bools or mask)"),
      field("rest", &Modification::rest, "Rest positions (vec3s or vec3d), at which the noise is looked up"));
}

}  // namespace solidnoise
