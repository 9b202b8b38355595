#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reference/gabor_reference.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise::bench {

// What is measured: blocks of voxels that are evaluated leaf by leaf, as volumes are.

inline constexpr int kLeaf = 8;
inline constexpr int kBlock = 32;

// Leaves of 8^3 voxels, in the block of a side of `leaves` leaves whose first voxel is `corner`; in 4D, one
// frame of them.
template <int Dim>
Lattice<Dim> leaf_lattice(const Index<Dim>& corner, int leaves, int leaf) {
  Lattice<Dim> lattice;
  lattice.first = corner;
  for (int axis = 0; axis < 3; ++axis, leaf /= leaves) {
    lattice.first[axis] += leaf % leaves * kLeaf;
    lattice.count[axis] = kLeaf;
  }
  return lattice;
}

// Evaluates leaf by leaf into the same samples; calls done() after each.
template <int Dim, typename Done>
void evaluate_block(const Noise<Dim>& noise, const Index<Dim>& corner, int side,
                    const Samples<Dim>& leaf_samples, const Done& done) {
  const int leaves = side / kLeaf;
  Box<Dim> box{Vec<Dim>(corner), Vec<Dim>(corner)};
  for (int axis = 0; axis < 3; ++axis) box.upper[axis] += side - 1;
  const auto block = noise.block(box);
  for (int leaf = 0; leaf < leaves * leaves * leaves; ++leaf) {
    block->evaluate(leaf_lattice<Dim>(corner, leaves, leaf), leaf_samples);
    done();
  }
}

// A Gabor noise whose kernel has this radius, with `impulses` in the ball of that radius. Radii go with 1 /
// frequency, and densities with the number of impulses, however a noise counts them.
template <template <int> class Noise, int Dim, typename Options>
std::shared_ptr<const Noise<Dim>> make_gabor(double radius, double impulses) {
  const double frequency = Noise<Dim>(Options{.frequency = 1.0}).radius() / radius;
  const double density = impulses / (reference::kBall<Dim> * std::pow(radius, Dim));
  const double density_of_one =
      Noise<Dim>(Options{.frequency = frequency, .impulses = 1.0}).impulse_density();
  return std::make_shared<Noise<Dim>>(Options{.frequency = frequency, .impulses = density / density_of_one});
}

}  // namespace solidnoise::bench
