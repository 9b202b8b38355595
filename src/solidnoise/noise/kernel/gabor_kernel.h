#pragma once

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Gabor kernel in Dim dimensions (1 to 4), the oriented one: a Gaussian times one plane wave,
//   g(x) = K exp(-pi a^2 |x|^2) cos(2 pi w.x + phase),
// x in world units, w and a in cycles per world unit, |w| the principal frequency F0. (Lagae et al. 2009, and
// 2011, eq. 2, in n dimensions and with a phase.) The phase is a random variable, uniform on a circle: the
// kernel's mean is 0, so that impulses need no random weight, and nothing of the Gaussian at frequency 0 is
// left that a fixed phase has. All statistics are means over the phase; a noise of these kernels, one
// independent phase per impulse, has `density` times power_spectrum(), energy() and autocorrelation() as
// spectrum, variance and covariance. (Lagae and Drettakis 2011, as used by Galerne et al. 2012; in n
// dimensions.)
template <int Dim>
class RandomPhaseGaborKernel {
 public:
  // Amplitude K >= 0, Gaussian parameter a > 0, frequency w finite; throws std::invalid_argument.
  RandomPhaseGaborKernel(double amplitude, double a, const Vec<Dim>& frequency);

  double amplitude() const { return amplitude_; }
  double a() const { return a_; }
  const Vec<Dim>& frequency() const { return frequency_; }

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

  // Relative RMS error of a noise whose kernel is cut to a ball: e^2 = Q(n/2, 2 pi a^2 r^2), Q the upper
  // incomplete gamma function.
  double relative_error(double radius) const;
  // The radius at which relative_error() is `error`, in ]0, 1[.
  double radius_for_error(double error) const;

  // The kernel after filtering with the frequency response exp(-pi f^2 / b^2), b > 0: again a Gabor kernel,
  // exactly.
  //   a' = a b / sqrt(a^2 + b^2),  w' = w b^2 / (a^2 + b^2),  K' = K (a'/a)^n exp(-pi F0^2 / (a^2 + b^2)),
  // the phase stays.
  RandomPhaseGaborKernel filtered(double b) const;

 private:
  double amplitude_;
  double a_;
  Vec<Dim> frequency_;
};

// The same of amplitude 1 and phase 0, for impulses whose random weights have mean 0: that of -w is that of
// w, so that a field of directions needs no sense. Statistics are means over all directions of w.
template <int Dim>
class EvenGaborKernel {
 public:
  // Gaussian parameter a > 0, principal frequency F0 >= 0; throws std::invalid_argument.
  EvenGaborKernel(double a, double frequency);

  double a() const { return a_; }
  double frequency() const { return frequency_; }

  // Integral of g^2: (1 + exp(-2 pi F0^2 / a^2)) / (2 (sqrt2 a)^n).
  double energy() const;
  // Integral of g^4: (3/8 + exp(-pi F0^2 / a^2) / 2 + exp(-4 pi F0^2 / a^2) / 8) / (2 a)^n.
  double fourth_moment() const;
  // Mean square of the Fourier transform of g^2, over all directions: a function of |f|.
  double squared_power(double f) const;

  double radius_for_error(double error) const;  // as a random phase has it

 private:
  double a_;
  double frequency_;
};

extern template class EvenGaborKernel<1>;
extern template class EvenGaborKernel<2>;
extern template class EvenGaborKernel<3>;
extern template class EvenGaborKernel<4>;

extern template class RandomPhaseGaborKernel<1>;
extern template class RandomPhaseGaborKernel<2>;
extern template class RandomPhaseGaborKernel<3>;
extern template class RandomPhaseGaborKernel<4>;

}  // namespace solidnoise
