#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/gradient_lattice.h"
#include "solidnoise/noise/gradient_tile.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The gradients of all lattice points that reach a box, ready to be looked up. Empty `indices`: none are
// known.
template <int Dim>
struct KnownGradients {
  CellBox<Dim> cells;
  std::vector<std::uint8_t> indices;
};

// Evaluates gradient noise: locates samples in the grid of cells, gathers them into tiles or clusters for the
// vectorised sums, and scatters what comes back.
template <int Dim>
class GradientEvaluator {
 public:
  // Coefficients of the kernel c1 t^5 - c2 t^4, and what the sum is multiplied by.
  struct Shape {
    double c1 = 4.0;
    double c2 = 3.0;
    double amplitude = 1.0;
  };

  GradientEvaluator(const GradientNoiseOptions& options, const std::array<CellAxis, Dim>& axes,
                    const Shape& shape);

  // Looks up the gradients around a box, unless they are too many to keep.
  KnownGradients<Dim> gradients_around(const Box<Dim>& box) const;

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples,
                const KnownGradients<Dim>& known) const;
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const;

 private:
  struct LocatedAxis;
  struct LocatedPoint;
  struct TileSpan;

  void evaluate_tile(const Lattice<Dim>& lattice, const TileSpan& span, const KnownGradients<Dim>& known,
                     const Samples<Dim>& samples) const;
  // Locates up to `count` samples of an axis from `first`, fewer if they span more than a tile may.
  LocatedAxis locate(const Lattice<Dim>& lattice, int axis, int first, int count) const;
  void evaluate_batch(const Points<Dim>& points, std::size_t first, std::size_t count,
                      const Samples<Dim>& samples) const;

  std::array<CellAxis, Dim> axes_;
  GradientLattice<Dim> lattice_;
  int reach_cells_;                    // the kernel's radius, in cells
  float cell_in_radii_;                // a cell's side
  std::array<float, Dim> per_radius_;  // 1 / (the kernel's radius in world units)
  alignas(64) float gradients_[kGradients][kGradientRoles] = {};
  GradientSum sum_;
};

extern template class GradientEvaluator<1>;
extern template class GradientEvaluator<2>;
extern template class GradientEvaluator<3>;
extern template class GradientEvaluator<4>;

}  // namespace solidnoise
