#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

// The papers' Gabor kernels with their random marks, and what the papers' procedure draws them from. Shares
// no code with the library. (Lagae et al., "Procedural noise using sparse Gabor convolution", 2009, and
// "Improving Gabor noise", 2011.)
namespace solidnoise::reference {

template <int Dim, typename Real = double>
using Position = std::array<Real, Dim>;

// The draws of one cell: a 32-bit linear congruential generator.
class CellGenerator {
 public:
  template <std::size_t kDim>
  CellGenerator(const std::array<std::int32_t, kDim>& cell, std::uint32_t seed) : state_(seed) {
    for (const std::int32_t coordinate : cell)
      state_ = state_ * 0x9e3779b1u + static_cast<std::uint32_t>(coordinate);
    // Neighbouring cells differ in few bits; spread the difference over all of them.
    state_ = (state_ ^ (state_ >> 16)) * 0x7feb352du;
    state_ = (state_ ^ (state_ >> 15)) * 0x846ca68bu;
    state_ ^= state_ >> 16;
  }

  // Uniform on [0, 1).
  template <typename Real>
  Real next() {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<Real>(state_ >> 8) * static_cast<Real>(0x1p-24);
  }

  // Poisson distributed: as many uniform numbers as keep their product above exp(-mean).
  template <typename Real>
  int next_poisson(Real exp_minus_mean) {
    int count = 0;
    for (Real product = next<Real>(); product > exp_minus_mean; product *= next<Real>()) ++count;
    return count;
  }

 private:
  std::uint32_t state_;
};

// Mean of the cosine of z u.e over all unit vectors u of n dimensions: the wave of an isotropic kernel.
template <int Dim, typename Real>
Real mean_cosine(Real z) {
  if constexpr (Dim == 1) {
    return std::cos(z);
  } else {
    if (z < static_cast<Real>(1e-4)) return 1 - z * z / (2 * Dim);
    if constexpr (Dim == 2) return static_cast<Real>(::j0(static_cast<double>(z)));
    if constexpr (Dim == 3) return std::sin(z) / z;
    if constexpr (Dim == 4) return static_cast<Real>(2 * ::j1(static_cast<double>(z))) / z;
  }
}

// A direction, uniform on the unit sphere, from Dim - 1 numbers uniform on [0, 1).
template <int Dim, typename Real>
Position<Dim, Real> uniform_direction(const std::array<Real, 3>& u) {
  constexpr Real kTurn = 2 * std::numbers::pi_v<Real>;
  if constexpr (Dim == 1) return {1};
  if constexpr (Dim == 2) return {std::cos(kTurn * u[0]), std::sin(kTurn * u[0])};
  if constexpr (Dim == 3) {
    const Real height = 2 * u[0] - 1, radius = std::sqrt(1 - height * height);
    return {radius * std::cos(kTurn * u[1]), radius * std::sin(kTurn * u[1]), height};
  }
  if constexpr (Dim == 4) {
    const Real first = std::sqrt(u[0]), second = std::sqrt(1 - u[0]);
    return {first * std::cos(kTurn * u[1]), first * std::sin(kTurn * u[1]), second * std::cos(kTurn * u[2]),
            second * std::sin(kTurn * u[2])};
  }
}

// Frequency F0 and Gaussian parameter a, in cycles per world unit.
struct KernelParameters {
  double frequency = 1.0;
  double a = 1.0;
};

// Isotropic Gabor kernel of unit peak (2011, eqs. 35 to 38), with a weight uniform on [-1, 1].
template <int Dim, typename Real = double>
struct IsotropicKernel {
  struct Mark {
    Real weight;
  };

  KernelParameters parameters;

  static Mark draw(CellGenerator& generator) { return {2 * generator.next<Real>() - 1}; }

  Real operator()(const Position<Dim, Real>&, Real squared_distance, const Mark& mark) const {
    constexpr Real kPi = std::numbers::pi_v<Real>;
    const Real frequency = static_cast<Real>(parameters.frequency), a = static_cast<Real>(parameters.a);
    return mark.weight * std::exp(-kPi * a * a * squared_distance) *
           mean_cosine<Dim, Real>(2 * kPi * frequency * std::sqrt(squared_distance));
  }

  // Mean over the marks and directions of the kernel's square at a distance.
  double mean_square(double r) const {
    const double gaussian = std::exp(-std::numbers::pi * parameters.a * parameters.a * r * r);
    const double wave = mean_cosine<Dim, double>(2 * std::numbers::pi * parameters.frequency * r);
    return gaussian * gaussian * wave * wave / 3.0;
  }
};

// Gabor kernel of unit peak with uniform random direction and phase (2009, eq. 1 with a phase; 2011).
template <int Dim, typename Real = double>
struct OrientedKernel {
  struct Mark {
    Real phase;             // in cycles
    std::array<Real, 3> u;  // what the direction is made of, when it is needed
  };

  KernelParameters parameters;

  static Mark draw(CellGenerator& generator) {
    Mark mark{};
    mark.phase = generator.next<Real>();
    for (int i = 0; i + 1 < Dim; ++i) mark.u[i] = generator.next<Real>();
    return mark;
  }

  Real operator()(const Position<Dim, Real>& offset, Real squared_distance, const Mark& mark) const {
    constexpr Real kPi = std::numbers::pi_v<Real>;
    const Real frequency = static_cast<Real>(parameters.frequency), a = static_cast<Real>(parameters.a);
    const Position<Dim, Real> direction = uniform_direction<Dim, Real>(mark.u);
    Real along = 0;
    for (int axis = 0; axis < Dim; ++axis) along += direction[axis] * offset[axis];
    return std::exp(-kPi * a * a * squared_distance) * std::cos(2 * kPi * (frequency * along + mark.phase));
  }

  double mean_square(double r) const {
    return std::exp(-2.0 * std::numbers::pi * parameters.a * parameters.a * r * r) / 2.0;
  }
};

}  // namespace solidnoise::reference
