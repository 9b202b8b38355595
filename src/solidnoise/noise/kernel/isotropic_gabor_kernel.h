#pragma once

namespace solidnoise {

// Isotropic Gabor kernel in Dim dimensions (1 to 4): a Gaussian times plane waves of one frequency from all
// directions,
//   g(r) = 2 pi K F0^(n/2) exp(-pi a^2 r^2) r^(1 - n/2) J_(n/2 - 1)(2 pi F0 r)
//        = g(0) exp(-pi a^2 r^2) mean_cosine(n, 2 pi F0 r),       g(0) = K S_n F0^(n-1),
// r in world units, F0 and a in cycles per world unit. (Lagae et al. 2011, eqs. 10 and 35 to 38; the papers
// give n = 2 and the general n, we write all of them as one formula, which is also exact at r = 0.)
template <int Dim>
class IsotropicGaborKernel {
 public:
  // Amplitude K >= 0 (0 for a kernel filtered to nothing), principal frequency F0 > 0 and Gaussian parameter
  // a > 0; throws std::invalid_argument.
  IsotropicGaborKernel(double amplitude, double frequency, double a);

  // The kernel with g(0) = 1: K = 1 / (S_n F0^(n-1)).
  static IsotropicGaborKernel with_unit_peak(double frequency, double a);

  double amplitude() const { return amplitude_; }
  double frequency() const { return frequency_; }
  double a() const { return a_; }
  double peak() const { return peak_; }  // g(0)

  double value(double r) const;
  double derivative(double r) const;  // dg/dr

  // Dim-dimensional Fourier transform at frequency f (eqs. 14 and 39 to 42, in a form that cannot overflow):
  //   G(f) = g(0) a^-n exp(-pi (f - F0)^2 / a^2) mean_exponential_scaled(n, 2 pi F0 f / a^2).
  double spectrum(double f) const;

  // Integral of g^2 over space (eqs. 43 to 46; in 43 and 45 as printed the exponent lacks the square of F0).
  double energy() const;

  // Integrals of g^4 and of (dg/dr)^2 over space, by quadrature.
  double fourth_moment() const;
  double gradient_energy() const;

  // Autocorrelation, the integral of g(x) g(x + d) over space, |d| = r; exact to 1e-12 of energy(). The
  // covariance of a noise, per unit of impulse density and of mean squared weight.
  double autocorrelation(double r) const;

  // Relative RMS error of a noise whose kernel is cut at a radius,
  //   e^2 = integral of g^2 r^(n-1) from radius to infinity / the same from 0.
  // (eqs. 21 to 23, with the factor r^(n-1) that a volume integral needs.)
  double relative_error(double radius) const;

  // The radius at which relative_error() is `error`, in ]0, 1[.
  double radius_for_error(double error) const;

  // The kernel after filtering with the frequency response exp(-pi f^2 / b^2), b > 0: again an isotropic
  // Gabor kernel, exactly.
  //   a' = a b / sqrt(a^2 + b^2),  F0' = F0 b^2 / (a^2 + b^2),
  //   K' = K ((a^2 + b^2) / b^2)^(n/2 - 1) exp(-pi F0^2 / (a^2 + b^2)).
  IsotropicGaborKernel filtered(double b) const;

 private:
  double amplitude_;
  double frequency_;
  double a_;
  double peak_;
};

}  // namespace solidnoise
