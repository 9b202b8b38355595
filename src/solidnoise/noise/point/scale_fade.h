#pragma once

namespace solidnoise {

// How a noise whose kernel's scale r, a length of it, changes from place to place gets its impulses. There is
// a grid for each power of two, with cells of size 2^l and impulses of their own, and a point uses the two
// grids l and l + 1 with 2^l <= r < 2^(l+1) (the hierarchy of grids of Lagae et al. 2011, section V). The
// variance has to be the same for every r.
//
// Each impulse carries the density y at which it has its turn, in units of what r asks for,
//   y = (r / 2^l)^n (2^-n + (1 - 2^-n) u),   u uniform on [0, 1),
// and its kernel is multiplied by
//   fade(y) = S(min((y - 2^-n) / rise, (1 - y) / fall)),  S(x) = 3 x^2 - 2 x^3, x clamped to 0 to 1,
// which is 0 outside of 2^-n < y < 1, the range that the two grids have between them. Impulses come and go
// one by one as r changes, and only as many are evaluated as are needed. The process being one of uniform
// density in y, variance and spectrum are the same for every r, and of a Poisson process all statistics
// (Campbell's theorem). In strata, in space and in u, the excess kurtosis is around 0 (ScaleLayout).
//
// The paper weights the sums over the two grids instead (eqs. 25 and 26), which are weights of powers: as
// amplitudes, r = (1 + alpha) 2^l, they leave half of the variance at alpha = 1/3, and their square roots
// keep the variance, but not the kurtosis, at up to 2^n times as many impulses.
struct ScaleFade {
  explicit ScaleFade(int n);

  double operator()(double y) const;

  int dimensions;
  double lowest;  // 2^-n
  double rise;    // widths in y
  double fall = 0.25;
  double second_moment;  // integral of fade^2 over y
  double fourth_moment;
  // Impulses of full density (y up to 1) for which the noise is as near to Gaussian as with one impulse that
  // is always there: fourth_moment / second_moment^2.
  double impulses_per_effective_one;
};

}  // namespace solidnoise
