#pragma once

namespace solidnoise {

// Surface area S_n = 2 pi^(n/2) / Gamma(n/2) of the unit sphere in n >= 1 dimensions: 2, 2 pi, 4 pi, 2 pi^2.
double unit_sphere_area(int n);

// Volume V_n = S_n / n of the unit ball in n >= 1 dimensions: 2, pi, 4 pi / 3, pi^2 / 2.
double unit_ball_volume(int n);

// exp(-x) I_order(x), the scaled modified Bessel function of the first kind; order from -1/2 to 4, x >= 0
// (x > 0 for a negative order). Never overflows; relative error about 1e-15.
double bessel_i_scaled(double order, double x);

// Mean of cos(z u.e) over the unit directions u of n dimensions, e any unit vector: the radial profile of a
// sum of plane waves from all directions,
//   Gamma(n/2) (2/z)^nu J_nu(z), nu = n/2 - 1;   cos z, J_0(z), sin z / z, 2 J_1(z) / z for n = 1 to 4.
// It is 1 at z = 0, and its derivative is -(z/n) mean_cosine(n + 2, z).
double mean_cosine(int n, double z);

// exp(-z) times the mean of exp(z u.e) over the unit directions u of n dimensions (1 to 10), z >= 0:
//   exp(-z) Gamma(n/2) (2/z)^nu I_nu(z), nu = n/2 - 1.
// It is 1 at z = 0. Never overflows.
double mean_exponential_scaled(int n, double z);

// Regularised upper incomplete gamma function Q(s, x) = Gamma(s, x) / Gamma(s); s > 0, x >= 0. Keeps its
// relative accuracy in the far tail. (Q(k/2, c/2) is the probability that chi-square with k degrees of
// freedom exceeds c.)
double regularized_gamma_q(double s, double x);

}  // namespace solidnoise
