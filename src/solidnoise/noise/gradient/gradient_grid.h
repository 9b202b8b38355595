#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/gradient/gradient_lattice.h"
#include "solidnoise/noise/gradient/gradient_tile.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A gradient noise as its evaluation needs it: the grid of cells along each axis, the gradients, and the
// numbers that the vectorised sums take. The kernel's radius is the unit of length there.
template <int Dim>
class GradientGrid {
 public:
  // Coefficients of the kernel c1 t^5 - c2 t^4, and what the sum is multiplied by.
  struct Shape {
    double c1 = 4.0;
    double c2 = 3.0;
    double amplitude = 1.0;
  };

  GradientGrid(const GradientNoiseOptions& options, const std::array<CellAxis, Dim>& axes,
               const Shape& shape);
  GradientGrid(const GradientGrid&) = delete;  // sum() points into the grid
  GradientGrid& operator=(const GradientGrid&) = delete;

  const std::array<CellAxis, Dim>& axes() const { return axes_; }
  const CellAxis& axis(int axis) const { return axes_[static_cast<std::size_t>(axis)]; }
  const GradientLattice<Dim>& lattice() const { return lattice_; }
  int reach_cells() const { return reach_cells_; }        // the kernel's radius, in cells
  float cell_in_radii() const { return cell_in_radii_; }  // a cell's side
  // Derivatives per world unit are this times those per radius.
  float derivative_factor(int axis) const { return derivative_factor_[static_cast<std::size_t>(axis)]; }
  const GradientSum& sum() const { return sum_; }

 private:
  std::array<CellAxis, Dim> axes_;
  GradientLattice<Dim> lattice_;
  int reach_cells_;
  float cell_in_radii_;
  std::array<float, Dim> derivative_factor_;
  float gradients_[kGradients][kGradientRoles] = {};
  GradientSum sum_;
};

// The gradients of all lattice points that reach a box, ready to be looked up. Empty `indices`: none are
// known.
template <int Dim>
struct KnownGradients {
  CellBox<Dim> cells;
  std::vector<std::uint8_t> indices;
};

// Looks up the gradients around a box, unless they are too many to keep.
template <int Dim>
KnownGradients<Dim> gradients_around(const GradientGrid<Dim>& grid, const Box<Dim>& box);

// Evaluation: samples are located in the grid of cells, gathered into tiles or clusters for the vectorised
// sums, and the results scattered. What is not known is looked up.
template <int Dim>
void evaluate_gradient_noise(const GradientGrid<Dim>& grid, const KnownGradients<Dim>& known,
                             const Lattice<Dim>& lattice, const Samples<Dim>& samples);
template <int Dim>
void evaluate_gradient_noise(const GradientGrid<Dim>& grid, const Points<Dim>& points,
                             const Samples<Dim>& samples);

}  // namespace solidnoise
