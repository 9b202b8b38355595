#pragma once

#include <span>
#include <vector>

#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise {

// The powers of t of which kernels are made: of radial ones, and of those that are a product of one for each
// axis.
inline constexpr int kRadialTaper = 4;
inline constexpr int kAxisTaper = 3;

// A radial function of compact support in n dimensions,
//   g_t(r) = t^k P(v) for r < R, else 0;   t = 1 - (r/R)^2, v = t - 1/2 in [-1/2, 1/2],
// with P a polynomial. It is even and smooth in r, and its value and its derivatives below the k-th vanish at
// R whatever P is, so that a noise made of it has no seam, and neither has its gradient. Where it stands for
// the values of a kernel g of unlimited support, P is the best choice in the least-squares sense over space;
// then the integral of g g_t is that of g_t^2, and
//   integral of (g - g_t)^2 = integral of g^2 - integral of g_t^2.
// r and R in world units.
class CompactKernel {
 public:
  // `chebyshev` are the coefficients of t^(k - 2) P in Chebyshev polynomials of u = 2 v, from degree 0; at
  // least k - 1. `relative_error` is what relative_error() returns.
  CompactKernel(int dimensions, double radius, std::vector<double> chebyshev, double relative_error,
                int taper = kRadialTaper);

  int dimensions() const { return dimensions_; }
  double radius() const { return radius_; }
  int taper() const { return taper_; }                                             // k
  int degree() const { return static_cast<int>(chebyshev_.size()) + 1 - taper_; }  // of P

  // P in powers of v, from degree 0: for Horner's rule. And Q of d(t^k P)/dt = t^(k - 1) Q, likewise.
  std::span<const double> power_coefficients() const { return power_; }
  std::vector<double> power_slope() const;
  // t^(k - 2) P in Chebyshev polynomials of u = 2 v, from degree 0: for Clenshaw's rule. (P itself is as
  // large at R as the kernel is flat, and in narrow bands its middle would be lost beside that. With all of
  // t^k in the series the gradient would not end at exactly 0.)
  std::span<const double> chebyshev_coefficients() const { return chebyshev_; }
  // t^(k - 2) Q, likewise.
  std::span<const double> chebyshev_slope() const { return slope_; }

  // Whether Horner's rule in single precision adds an RMS error to values, relative to the kernel, of at most
  // a hundredth of relative_error() and 3e-5; measured at construction. Nearly all kernels of half an octave
  // or more are. Otherwise use Clenshaw's rule, which in single precision adds less than 1e-4 for bandwidths
  // from 0.1 octaves and 1e-3 at 0.05 octaves.
  bool well_conditioned() const { return well_conditioned_; }

  double value(double r) const;
  double derivative(double r) const;  // d g_t / dr

  // n-dimensional Fourier transform at frequency f, cycles per world unit; exact to about 1e-12 of its
  // maximum.
  double spectrum(double f) const;

  double energy() const { return energy_; }                  // integral of g_t^2 over space
  double fourth_moment() const { return fourth_moment_; }    // integral of g_t^4 over space
  double gradient_energy() const;                            // integral of (d g_t / dr)^2 over space
  double relative_error() const { return relative_error_; }  // sqrt(integral (g - g_t)^2 / integral g^2)

 private:
  // A quadrature over the ball: the integral of g_t h is the sum of integrals[i] h(radii[i]), h a radial
  // function.
  struct Shells {
    std::vector<double> radii;
    std::vector<double> integrals;
  };
  Shells make_shells(int count) const;
  double horner_rounding() const;
  double transform(const Shells& shells, double f) const;

  int dimensions_;
  double radius_;
  int taper_;
  std::vector<double> chebyshev_;
  std::vector<double> slope_;
  std::vector<double> power_;
  Shells shells_;
  double energy_ = 0.0;
  double fourth_moment_ = 0.0;
  double relative_error_;
  bool well_conditioned_ = false;
};

// The cheapest compact kernel within a relative RMS error (1e-5 to 0.9; truncation and fit together) of a
// Gabor kernel: over all degrees d >= 1 and radii R that reach the error, the one of least (d + 5) R^Dim,
// which is what an impulse costs (odd d count as the next even one). The papers cut the kernel off instead;
// that leaves a step at the radius, and needs a larger radius for the same error as soon as the step is
// windowed away. Throws std::invalid_argument for an error out of range. Takes about a millisecond for a
// bandwidth of an octave.
//
// The best kernels for values are up to three times that far from the gradient, relative to its own root mean
// square over space (gradient_error()): what they lack is of high frequencies. With `bounds_gradient` P is
// the best choice for both, relative errors of values and gradient counting the same, and both are within the
// error, for 1.15 to 1.4 times the cost.
template <int Dim>
CompactKernel compact_kernel(const IsotropicGaborKernel<Dim>& kernel, double error,
                             bool bounds_gradient = false);

// The compact form of the one-dimensional Gaussian exp(-pi a^2 d^2), as one factor per axis of a separable
// window in `dimensions` dimensions whose relative RMS error, all axes together, is `error`. The result is a
// one-dimensional kernel, the cheapest by (d + 13) R^dimensions, for the box counts more than the degree
// here: an axis' factors are shared by a whole lattice. With e its own relative error, that of the product is
// sqrt(1 - (1 - e^2)^dimensions).
CompactKernel compact_envelope(double a, int dimensions, double error);

// That of the radial Gaussian exp(-pi a^2 r^2) in `dimensions` dimensions; the cheapest by
// (d + 17) R^dimensions, for it is multiplied by a wave.
CompactKernel compact_gaussian(double a, int dimensions, double error);

// The compact kernel of a given radius, of the lowest degree >= 1 within the error, of values or, with
// `bounds_gradient`, of both. Kernels of similar parameters, compact on similar radii, are then alike, which
// the cheapest ones above need not be. Throws std::invalid_argument if the kernel has too much of its energy
// outside of the radius.
template <int Dim>
CompactKernel compact_kernel_at(const IsotropicGaborKernel<Dim>& kernel, double radius, double error,
                                bool bounds_gradient = false);

}  // namespace solidnoise
