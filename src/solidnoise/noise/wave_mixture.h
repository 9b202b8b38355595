#pragma once

#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// What the mean products of a field n and of its derivatives are, at distances 0, step, 2 step, ... along an
// axis x.
struct AxisCovariance {
  std::vector<double> value;           // E n(0) n(x) = C
  std::vector<double> value_to_slope;  // E n(0) dn/dx(x) = dC/dx
  std::vector<double> slope;           // E dn/dx(0) dn/dx(x) = -d^2 C/dx^2
  std::vector<double> lateral;         // E dn/dy(0) dn/dy(x), the sum over all other axes y
};

// The covariance of a stationary noise at places x apart, as a mixture of waves under one envelope:
//   C(x) = product over axes of rho(x_i)  times  sum over waves k of v_k wave(2 pi w_k, x).
// Every stationary noise here has that form: the waves are those that oriented kernels carry, under the
// autocorrelation rho(d) = exp(-pi a^2 d^2 / 2) of their Gaussian envelope; a radial spectrum is integrated
// by a quadrature whose nodes are waves, without an envelope. It is that of the kernels before they were made
// compact, which is the field that is wanted: compact kernels add weak high frequencies to it, errors that
// are in their own relative_error(). In that form whatever works axis by axis, such as interpolation, has
// statistics in closed form that cost no more than one sum over the waves. x in world units, w in cycles per
// unit.
template <int Dim>
struct WaveMixture {
  struct Wave {
    double variance = 0.0;
    Vec<Dim> frequency{0.0};
  };
  enum class Symmetry {
    point,  // a wave stands for w and -w: cos(2 pi w.x)
    mirror  // for all changes of signs of w's coordinates: the product of cos(2 pi w_i x_i)
  };

  std::vector<Wave> waves;  // none where the noise is not stationary, or is 0
  Symmetry symmetry = Symmetry::point;
  double a = 0.0;  // of the envelope, 1 / world unit; 0: rho is 1

  // The mean square by which kernels differ from these, for they are compact, and what of it are waves (of
  // the mixture's symmetry, without the envelope); the rest is of frequencies far above.
  double truncation = 0.0;
  std::vector<Wave> truncation_waves;

  // What evaluating a sample costs: the impulses that reach it, from how far (world units), and what each
  // takes over one of an isotropic kernel of an octave's width.
  double impulses = 0.0;
  double radius = 0.0;
  double work = 1.0;

  double variance() const;
  double covariance(const Vec<Dim>& x) const;

  // rho(x), 1 at 0.
  double envelope_correlation(double x) const;

  // At `count` distances.
  AxisCovariance along(int axis, double step, int count) const;

  // The mean square of the derivative along an axis of a wave of unit variance.
  double slope_variance(const Wave& wave, int axis) const;
};

// Directions that represent all directions of Dim dimensions together with their mirror images, all weights
// 1 / size: means over them of functions that are even along each axis, and smooth over so much as two cycles
// from one end of the sphere to the other, are exact to 1e-6 or better.
template <int Dim>
struct WeightedDirection {
  Vec<Dim> direction{0.0};
  double weight = 0.0;  // they add up to 1
};
template <int Dim>
std::vector<WeightedDirection<Dim>> mirrored_directions();

}  // namespace solidnoise
