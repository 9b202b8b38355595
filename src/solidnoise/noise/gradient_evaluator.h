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

// The most lattice points that a tile is given.
template <int Dim>
inline constexpr std::size_t kMostCells = GradientTile::kMaxRows* kMostCells<Dim - 1>;
template <>
inline constexpr std::size_t kMostCells<0> = 1;

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
  using LookedUp = std::array<std::uint8_t, kMostCells<Dim>>;

  // Locates samples of an axis from `first`: as many as a tile takes, or fewer if they span too many cells.
  LocatedAxis locate(const Lattice<Dim>& lattice, int axis, int first) const;
  void evaluate_tile(const Lattice<Dim>& lattice, const TileSpan& span, const KnownGradients<Dim>& known,
                     const Samples<Dim>& samples) const;
  void place_samples(const TileSpan& span, GradientTile& tile) const;
  // Points the tile to its gradients: the known ones, or else `looked_up`.
  void place_gradients(const TileSpan& span, const KnownGradients<Dim>& known, LookedUp& looked_up,
                       GradientTile& tile) const;
  // Copies results of a tile, times a factor, to where its samples are in the lattice.
  void scatter(const float* results, float factor, const Lattice<Dim>& lattice, const TileSpan& span,
               float* samples) const;
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
