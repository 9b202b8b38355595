#pragma once

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Closed forms of Kensler's wide gradient noise in Dim dimensions (1 to 4), in lattice units:
//   noise(x) = sum over lattice points i of s(|x - i|) (x - i).G_i,   G_i independent, uniform on the unit
//   sphere, s(r) = c1 t^5 - c2 t^4,  t = 1 - r^2/4,  0 for r >= 2.
// Kensler, Knoll, Shirley 2008, section 3: c1 = 4, c2 = 3. The paper writes the kernel for one dimension and
// evaluates it radially; so do we.
//
// The paper has no closed forms; these are ours. s(|x|) x is the gradient of (2 c2/5) t^5 - (c1/3) t^6, so
// with psi the n-dimensional Fourier transform of that, the spectrum averaged over a lattice cell is
//   S(f) = density (4 pi^2 f^2 / n) psi(f)^2
// with `density` lattice points per unit volume: 1, or 2^-n for Support::half (even coordinates only).
// The published coefficients leave psi(0) = 0 between n = 1 and n = 2 only, that is, power near f = 0, more
// with each dimension. Kernel::zero_dc demands psi(0) = 0 and keeps s(0) = 1: c2/c1 = 5 / (n/2 + 6), c1 - c2
// = 1.
//
// Gradients taken through the xor of permutations are not quite independent: those of two lattice points that
// differ in k coordinates correlate by (-1/255)^k, which changes the mean variance by less than 1 %.
template <int Dim>
class GradientKernel {
 public:
  using Kernel = GradientNoiseOptions::Kernel;
  using Support = GradientNoiseOptions::Support;

  static constexpr double kRadius = 2.0;

  explicit GradientKernel(Kernel kernel, Support support = Support::full);

  double c1() const { return c1_; }
  double c2() const { return c2_; }

  // s(r), r >= 0.
  double value(double r) const;

  // Variance of the noise, averaged over a lattice cell: density (S_n / n) times the integral of r^(n+1)
  // s(r)^2.
  double mean_variance() const;

  // Variance of a component of the noise's gradient, averaged over a lattice cell, per lattice unit squared:
  // density (S_n / n^2) times the integral of r^(n-1) (n s^2 + 2 r s s' + r^2 s'^2).
  double mean_gradient_variance() const;

  // S(f), f >= 0 in cycles per lattice unit; its integral over R^Dim is mean_variance().
  double power_spectrum(double f) const;

  // The frequency of the largest radial power f^(n-1) S(f).
  double radial_peak() const { return radial_peak_; }

  // Excess kurtosis of the values at all positions of a cell taken together. It has two parts: each term g.v
  // of the sum has the fourth cumulant -6 |v|^4 / (n^2 (n + 2)), and the variance varies over the cell, which
  // adds three times its squared coefficient of variation (a sum over its Fourier coefficients). For
  // independent gradients.
  double excess_kurtosis() const;

  // The frequencies (cycles per lattice unit) between which all but a thousandth of the variance lies, half
  // of that thousandth on either side.
  typename Noise<Dim>::Band band() const;

 private:
  // psi(f) and d psi / d f.
  double potential_transform(double f) const;
  double potential_transform_slope(double f) const;
  double find_radial_peak() const;

  double c1_ = 4.0;
  double c2_ = 3.0;
  double spacing_ = 1.0;  // of the lattice points, 1 or 2
  double density_ = 1.0;  // lattice points per unit volume
  double radial_peak_ = 0.0;
};

}  // namespace solidnoise
