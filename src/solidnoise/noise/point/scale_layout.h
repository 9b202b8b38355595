#pragma once

#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/kernel/impulse_strata.h"

namespace solidnoise {

// Where the impulses are of a noise whose kernels change from place to place (ScaleFade): the length of a
// kernel that tells which grids it takes, and how many impulses their cells have.
//
// In strata a cell has m = 2^n impulses, one in each orthant of it, and one with its turn u in each m-th of
// [0, 1); which orthant has which turn is random. So impulses of all turns are as even as in cells half as
// large, those of similar turns as in whole ones. With F_i the mean of fade^2 over part i of the turns, F the
// mean of the F_i and V the mean of (F_i - F)^2, o(c) the overlap of cubes of side c (KernelMoments), and
// cells of side c, a grid takes from the fourth cumulant, per impulse,
//   3 ((F^2 - V / (m - 1)) o(c / 2) + m / (m - 1) V o(c)).
// For two impulses of a cell are never in one orthant, nor in one part: in two others they are the likelier.
// Narrow bands, whose orthants would be too small for cells of twice their side (smallest_cell), have cells
// of quarters or eighths in place of halves, and 4^n or 8^n impulses in each. (Whole cells with as many
// parts, whose kernels take 3 (F^2 + V) o(c), need twice the impulses for the same excess kurtosis. Of 2^n
// and more in balanced cubes they are as good, and the cells are not too small. Mirrored impulses in the
// orthants would save a fifth of the impulses, but the excess kurtosis would go up and down twice as far.)
struct ScaleLayout {
  int dimensions = 3;
  double scale = 1.0;    // of the kernel that it was made for, world units
  ImpulseCount count{};  // of a cell

  // Impulses of all turns per scale^n.
  double density() const;
  // World units^-n, of what scale_layout() takes.
  double effective_density() const;

  // Of the noise whose kernel this was made for. Cells are smaller than balanced ones at one end of a grid's
  // range and larger at the other: of strata it is the mean over all scales, from which it differs by up to
  // 0.06 where that is 0. The kernel's moments may be those of its compact form.
  double excess_kurtosis(const StrataChoice& choice, const KernelMoments& moments) const;

  // How far that may be from its mean at a place in the planes of both grids' strata, a bound; the most of
  // all scales. 0 of a Poisson process.
  double kurtosis_given_place(const StrataChoice& choice) const;
};

// Of this density of effective impulses (of a Poisson process of as many the excess kurtosis is the same),
// world units^-n; 0: in strata the fewest for which the excess kurtosis is 0, or the choice's where that is
// more than kMeanKurtosis, or, where these are more than four times those of a Poisson process of
// kDefaultKurtosis, kMeanKurtosis, as of StrataChoice::fewest(); of a Poisson process those.
ScaleLayout scale_layout(const StrataChoice& choice, double density, ImpulseSpread spread);

}  // namespace solidnoise
