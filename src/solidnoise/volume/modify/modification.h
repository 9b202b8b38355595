#pragma once

#include <optional>

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

}  // namespace solidnoise
