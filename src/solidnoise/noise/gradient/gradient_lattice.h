#pragma once

#include <array>
#include <cstdint>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"

namespace solidnoise {

inline constexpr int kGradients = 256;

// 256 unit gradients for a seed, in a random order. Not 256 independent directions (as in the paper), whose
// mean and second moments would make each seed's noise a little louder, lopsided and anisotropic, but
// randomly rotated sets for which both are exact: the mean is 0 and the mean of g g^T is I/n for every seed.
// They are +1 and -1 in 1D, 64 crosses in 2D, the corners of 32 cubes in 3D, and 32 cross-polytopes in 4D.
template <int Dim>
std::array<Vec<Dim>, kGradients> make_gradients(std::uint64_t seed);

// A permutation of 0 to 255 for each axis.
template <int Dim>
std::array<std::array<std::uint8_t, 256>, Dim> make_permutations(std::uint64_t seed);

// The key of the integer hash for a seed.
std::uint64_t gradient_hash_key(std::uint64_t seed);

// Lattice cells of a box: `count` of them along each axis from `first`.
template <int Dim>
struct CellBox {
  Index<Dim> first{0};
  glm::vec<Dim, int> count{1};

  std::size_t size() const {
    std::size_t cells = 1;
    for (int axis = 0; axis < Dim; ++axis) cells *= static_cast<std::size_t>(count[axis]);
    return cells;
  }
};

// The random content of gradient noise: which of the 256 gradients each lattice point has. Points are counted
// in cells: a cell is one lattice step for Support::full, and two for Support::half, which keeps the points
// with even coordinates. After Kensler et al. 2008, section 2:
//   Hash::xor_tables: Px[i] ^ Py[j] ^ Pz[k] ^ Pt[l], indices modulo 256;
//   Hash::integer (ours): the low byte of hash_cell(i, j, k, l) with gradient_hash_key(seed).
// A period wraps the coordinates beforehand.
template <int Dim>
class GradientLattice {
 public:
  GradientLattice(const GradientNoiseOptions& options, const std::array<CellAxis, Dim>& axes);

  const std::array<Vec<Dim>, kGradients>& gradients() const { return gradients_; }

  // The index of the gradient at the lattice point that is the lower corner of `cell`.
  std::uint8_t gradient_index(const Index<Dim>& cell) const;

  // The same for each cell of a box, last axis fastest; `indices` has room for box.size().
  void gradient_indices(const CellBox<Dim>& box, std::uint8_t* indices) const;

 private:
  // The hash of no coordinates, and the hash with one more coordinate taken in, axis by axis.
  std::uint64_t first_hash() const;
  std::uint64_t extend_hash(std::uint64_t hash, int axis, std::int64_t cell) const;
  void fill_from_axis(int axis, std::uint64_t hash, const CellBox<Dim>& box, std::uint8_t*& next) const;

  std::array<CellAxis, Dim> axes_;
  GradientNoiseOptions::Hash hash_;
  std::int64_t steps_;  // lattice steps per cell
  std::uint64_t hash_key_;
  std::array<std::array<std::uint8_t, 256>, Dim> permutations_;
  std::array<Vec<Dim>, kGradients> gradients_;
};

}  // namespace solidnoise
