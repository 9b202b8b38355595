#pragma once

#include <array>
#include <cstdint>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {

// The grid of cells that a kernel of a given radius is evaluated on.
template <int Dim>
struct KernelCells {
  std::array<CellAxis, Dim> axes;
  std::array<double, Dim>
      radius{};         // of the kernel, in cells per axis: 1, or less where a period stretches the cells
  double volume = 1.0;  // of a cell, in world units^Dim

  // Another radius in cells, per axis.
  std::array<double, Dim> in_cells(double other_radius) const {
    std::array<double, Dim> cells{};
    for (int axis = 0; axis < Dim; ++axis) cells[axis] = other_radius / axes[axis].size();
    return cells;
  }
};

// Cells as large as the radius; along an axis with a period, larger by the least that makes the period a
// whole number of cells (so that it holds exactly, in world units). Throws std::invalid_argument for a period
// below two radii: the noise would then overlap itself, and its variance would not be the one that is
// promised.
template <int Dim>
KernelCells<Dim> make_kernel_cells(double radius, const Vec<4>& period);

// The kernel's polynomial as the vectorised loops take it: factored, which is quickest, within the limits
// (rounding is measured, and must be below a hundredth of the kernel's own error too; nearly all kernels of
// the degrees that are compiled are), else as a sum of Chebyshev polynomials.
RadialPolynomial to_single_precision(const CompactKernel& kernel, const FactoredLimits& limits);

// Streams of random numbers that a noise derives from its seed.
enum SeedStream : std::uint64_t { kImpulseStream = 1, kOctaveStream = 1000, kChannelStream = 2000 };

extern template KernelCells<1> make_kernel_cells<1>(double, const Vec<4>&);
extern template KernelCells<2> make_kernel_cells<2>(double, const Vec<4>&);
extern template KernelCells<3> make_kernel_cells<3>(double, const Vec<4>&);
extern template KernelCells<4> make_kernel_cells<4>(double, const Vec<4>&);

}  // namespace solidnoise
