#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Gabor kernel in Dim dimensions (1 to 4), the oriented one: a Gaussian times one plane wave,
//   g(x) = K exp(-pi a^2 |x|^2) cos(2 pi w.x + phase),
// x in world units, w and a in cycles per world unit, phase in radians. |w| is the principal frequency F0.
// (Lagae et al. 2009, and 2011, eq. 2, in n dimensions and with a phase.)
template <int Dim>
class GaborKernel {
 public:
  // Amplitude K >= 0, Gaussian parameter a > 0, frequency w and phase finite; throws std::invalid_argument.
  GaborKernel(double amplitude, double a, const Vec<Dim>& frequency, double phase);

  double amplitude() const { return amplitude_; }
  double a() const { return a_; }
  const Vec<Dim>& frequency() const { return frequency_; }
  double phase() const { return phase_; }

  double value(const Vec<Dim>& x) const;
  Vec<Dim> gradient(const Vec<Dim>& x) const;

  // Fourier transform: K / (2 a^n) times the sum of two Gaussians,
  //   exp(i phase) exp(-pi |f - w|^2 / a^2) + exp(-i phase) exp(-pi |f + w|^2 / a^2).
  // (eq. 4 of the 2011 paper writes one of the two for both.)
  std::complex<double> spectrum(const Vec<Dim>& f) const;

  // Integral of g^2 over space: K^2 / (2 (sqrt2 a)^n) (1 + cos(2 phase) exp(-2 pi F0^2 / a^2)).
  double energy() const;

  // K exp(-pi a^2 r^2): never less than |value()| at distance r from the centre.
  double envelope(double r) const;

  // Where the envelope falls to `fraction` of K; in ]0, 1].
  double radius_for_envelope(double fraction) const;

  // Relative RMS error of a noise whose kernel is cut to a ball: the square root of the share of energy()
  // outside.
  double relative_error(double radius) const;
  // The radius at which relative_error() is `error`, in ]0, 1[.
  double radius_for_error(double error) const;

  // The kernel after filtering with the frequency response exp(-pi f^2 / b^2), b > 0: again a Gabor kernel,
  // exactly.
  //   a' = a b / sqrt(a^2 + b^2),  w' = w b^2 / (a^2 + b^2),  K' = K (a'/a)^n exp(-pi F0^2 / (a^2 + b^2)),
  // the phase stays.
  GaborKernel filtered(double b) const;

 private:
  double amplitude_;
  double a_;
  Vec<Dim> frequency_;
  double phase_;
};

// The Gabor kernel whose phase is a random variable, uniform on a circle: its mean is 0, so that impulses
// need no random weight, and nothing of the Gaussian at frequency 0 is left that a fixed phase has. All
// statistics are means over the phase; a noise of these kernels, one independent phase per impulse, has
// `density` times power_spectrum(), energy() and autocorrelation() as spectrum, variance and covariance.
// (Lagae and Drettakis 2011, as used by Galerne et al. 2012; in n dimensions.)
template <int Dim>
class RandomPhaseGaborKernel {
 public:
  // Amplitude K >= 0, Gaussian parameter a > 0, frequency w finite; throws std::invalid_argument.
  RandomPhaseGaborKernel(double amplitude, double a, const Vec<Dim>& frequency);

  double amplitude() const { return amplitude_; }
  double a() const { return a_; }
  const Vec<Dim>& frequency() const { return frequency_; }

  GaborKernel<Dim> with_phase(double phase) const { return {amplitude_, a_, frequency_, phase}; }

  // Mean of |G(f)|^2: K^2 / (4 a^2n) (exp(-2 pi |f - w|^2 / a^2) + exp(-2 pi |f + w|^2 / a^2)).
  double power_spectrum(const Vec<Dim>& f) const;

  // The same, also averaged over all directions of w: a function of |f|,
  //   K^2 / (2 a^2n) exp(-2 pi (f - F0)^2 / a^2) mean_exponential_scaled(n, 4 pi F0 f / a^2).
  // Nearly the shape of an isotropic kernel's squared spectrum where F0 is much larger than a, but not the
  // same.
  double isotropic_power_spectrum(double f) const;

  // Mean of the integral of g^2 over space: K^2 / (2 (sqrt2 a)^n). Directions do not matter.
  double energy() const;
  // Mean of the integral of g^4 over space: 3/8 K^4 / (2 a)^n.
  double fourth_moment() const;
  // Mean of the integral of g(y) g(y + x) over y: energy() exp(-pi a^2 |x|^2 / 2) cos(2 pi w.x).
  double autocorrelation(const Vec<Dim>& x) const;

  // Where the envelope falls to `fraction` of its maximum; in ]0, 1].
  double radius_for_envelope(double fraction) const;

  // Relative RMS error of a noise whose kernel is cut to a ball: e^2 = Q(n/2, 2 pi a^2 r^2), Q the upper
  // incomplete gamma function.
  double relative_error(double radius) const;
  // The radius at which relative_error() is `error`, in ]0, 1[.
  double radius_for_error(double error) const;

  // As GaborKernel::filtered().
  RandomPhaseGaborKernel filtered(double b) const;

  // The kernel in M <= Dim dimensions whose noise has the spectrum that the noise of this one has on the
  // slice where all coordinates but the first M are constant: same a, projected w, K' = K (sqrt2 a)^((M - n)
  // / 2).
  template <int M>
  RandomPhaseGaborKernel<M> sliced() const;

 private:
  double amplitude_;
  double a_;
  Vec<Dim> frequency_;
};

template <int Dim>
template <int M>
RandomPhaseGaborKernel<M> RandomPhaseGaborKernel<Dim>::sliced() const {
  static_assert(1 <= M && M <= Dim);
  Vec<M> projected;
  for (int axis = 0; axis < M; ++axis) projected[axis] = frequency_[axis];
  return {amplitude_ * std::pow(std::numbers::sqrt2 * a_, 0.5 * (M - Dim)), a_, projected};
}

extern template class RandomPhaseGaborKernel<1>;
extern template class RandomPhaseGaborKernel<2>;
extern template class RandomPhaseGaborKernel<3>;
extern template class RandomPhaseGaborKernel<4>;

}  // namespace solidnoise
