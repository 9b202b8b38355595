#pragma once

namespace solidnoise {

// How a noise whose kernel radius r changes from place to place gets its impulses. There is a grid for each
// power of two, with cells of size 2^l and impulses of their own, and a point uses the two grids l and l + 1
// with 2^l <= r < 2^(l+1) (the hierarchy of grids of Lagae et al. 2011, section V). The variance has to be
// the same for every r.
enum class ScaleTransition {
  // Ours, the default. Each impulse carries the density y at which it has its turn, in units of what r asks
  // for,
  //   y = (r / 2^l)^n (2^-n + (1 - 2^-n) u),   u uniform on [0, 1),
  // and its kernel is multiplied by fade(y), which is 0 outside of 2^-n < y < 1, the range that the two grids
  // have between them. Impulses come and go one by one as r changes, and only as many are evaluated as are
  // needed. The process being one of uniform density in y, variance and spectrum are the same for every r,
  // and of a
  // Poisson process all statistics (Campbell's theorem). In strata, in space and in u, the excess kurtosis is
  // around 0: cells are smaller than balanced ones at one end of a grid's range and larger at the other.
  fade,
  // All impulses of both grids, the sums weighted so that their powers add up to 1: by the square roots of
  // eqs. 25 and 26 in n dimensions, smoothed,
  //   w0 = cos(pi/2 s) (1 + alpha)^(-n/2),  w1 = 2^(n/2) sin(pi/2 s) (1 + alpha)^(-n/2),
  //   r = (1 + alpha) 2^l,  s = 3 alpha^2 - 2 alpha^3.
  // The variance is the same for every r, the kurtosis is not; sums up to 2^n times as many impulses.
  power,
  // The paper's own weights, eqs. 25 and 26 in n dimensions: w0 = (1 - alpha) (1 + alpha)^-n, w1 = 2^n alpha
  // (1 + alpha)^-n. They keep the weighted number of impulses; the variance falls to a half between two
  // grids. For comparison.
  paper,
};

// Weights of the sums over the grids l and l + 1.
struct ScaleWeights {
  double fine = 1.0;
  double coarse = 0.0;
};
// alpha in [0, 1), n dimensions; 1 and 1 for `fade`, whose weights are those of the impulses.
ScaleWeights scale_weights(ScaleTransition transition, int n, double alpha);

// The variance, relative to what it should be, of a noise with these weights:
//   fine^2 (1 + alpha)^n + coarse^2 (1 + alpha)^n / 2^n.
double scale_variance(const ScaleWeights& weights, int n, double alpha);

// The factor of an impulse, and its integrals over y:
//   fade(y) = S(min((y - 2^-n) / rise, (1 - y) / fall)),  S(x) = 3 x^2 - 2 x^3, x clamped to 0 to 1.
struct ScaleFade {
  explicit ScaleFade(int n);

  double operator()(double y) const;

  double lowest;  // 2^-n
  double rise;    // widths in y
  double fall = 0.25;
  double second_moment;  // integral of fade^2
  double fourth_moment;
  // Impulses of full density (y up to 1) for which the noise is as near to Gaussian as with one impulse that
  // is always there: fourth_moment / second_moment^2.
  double impulses_per_effective_one;
};

}  // namespace solidnoise
