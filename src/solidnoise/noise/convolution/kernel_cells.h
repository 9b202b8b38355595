#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/impulse_strata.h"

namespace solidnoise {

// Where a noise's impulses are: the grid of their cells, and how many there are in each.
template <int Dim>
struct ImpulseLayout {
  std::array<CellAxis, Dim> axes;
  ImpulseCount count;
  double density = 1.0;  // impulses per world unit^Dim

  // A kernel's radius in cells, per axis.
  std::array<double, Dim> in_cells(double radius) const {
    std::array<double, Dim> cells{};
    for (int axis = 0; axis < Dim; ++axis) cells[axis] = radius / axes[axis].size();
    return cells;
  }
  // Of a cube as large as a cell, and the cubes as large as its pieces, if it has any: of strata.
  double cell_side() const { return std::pow(count.mean / density, 1.0 / Dim); }
  Cubes cubes() const { return {std::ldexp(cell_side(), -count.halvings), count.mirrored}; }
};

// The layout of impulses of a density (world units^-Dim; 0: the fewest that look Gaussian,
// StrataChoice::fewest or of a Poisson process kDefaultKurtosis). Along an axis with a period cells are
// stretched or shrunk by the least that makes the period a whole number of them, so that it holds exactly;
// strata keep their number of impulses, a Poisson process its density. Throws std::invalid_argument for a
// period below two radii of the kernel: the noise would overlap itself, and its variance would not be the one
// that is promised.
template <int Dim>
ImpulseLayout<Dim> make_layout(const StrataChoice& choice, double density, ImpulseSpread spread,
                               double radius, const Vec<4>& period);

// The kernel's polynomial as the vectorised loops take it: in powers where these are accurate enough and the
// loops are compiled for the degree, else by Clenshaw's rule.
RadialPolynomial to_single_precision(const CompactKernel& kernel, int most_degree);

// Streams of random numbers that a noise derives from its seed.
enum SeedStream : std::uint64_t { kImpulseStream = 1, kOctaveStream = 1000, kChannelStream = 2000 };

}  // namespace solidnoise
