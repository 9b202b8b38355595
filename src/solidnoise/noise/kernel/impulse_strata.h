#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "solidnoise/noise/kernel/cube_averages.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise {

// Impulses in strata. Space is cut into cubes of one side c, each of which holds the same number m of
// impulses, at independent uniform places or in pairs of a place and its mirror image at the cube's centre;
// planes, rows and cubes of them are shifted at random (ImpulseProcess), so that the process is stationary.
// The marks of impulses (weight, phase, direction) are independent and of mean 0. Then the covariance of the
// noise, and so its spectrum, is that of the Poisson process of the same density, exactly: two different
// impulses never correlate. The fourth cumulant is not. With M(x) = E g(x)^2 and Q(x) = E g(x)^4, means over
// the marks, and h the uniform density of a cube around 0,
//   kappa_4 = density (integral of Q  -  3 integral of (h * M)^2)
// of independent places: of the pairs of impulses that a Poisson process has in a cube, m strata have
// m (m - 1) in place of m^2. Each of 2 j mirrored impulses has 2 j - 2 independent others, and its image:
//   kappa_4 = density (integral of Q  -  3 integral of (2 (h * M)^2 - P)),
// P(p) the mean over places x in the cube of M(p - x) M(p + x). What is taken from Q, the overlap, falls as
// the side grows; where the two terms cancel, the side is balanced. The squared distance of two impulses that
// are mirrored is twice that of two that are not, so that larger cubes with two are balanced: of isotropic
// kernels of an octave of 0.83 times the density in 3D and 0.69 times in 4D, of waves of random phase 0.71
// and 0.54 times, in the layers of surfaces 0.78 and, of waves of phase 0, 0.71 times. In 2D it would be 0.95
// times, with tails that are too short, in 1D more. Waves of random phase are not mirrored in 3D: so few of
// random directions would be seen one by one, as folds that cross, though the values are Gaussian.
//
// Impulses in the cubes of a wave of random phase, g = E(x) cos: kappa_4 is 1 - 2 T of the Poisson process',
// T the share of the integral of E^4 that the overlap is of E^2. Of a wave of phase 0 the square of the wave
// is in both integrals, which is next to nothing up to an octave and a fifth of them at two.
//
// The sixth cumulant, which values past four standard deviations go with, adds up cube by cube, too. With
// S(x) = E g(x)^6, of independent places
//   kappa_6 = density (integral of S  -  15 integral of (h * Q) (h * M)  +  30 integral of (h * M)^3),
// of mirrored ones, with R the mean of Q(p - x) M(p + x),
//   kappa_6 = density (integral of S + 15 R - 30 (h * Q) (h * M) - 90 P (h * M) + 120 (h * M)^3).
// Over the cube of the variance, of waves under exp(-pi a^2 r^2) in balanced cubes, 0.18, 0.64 and 1.02 times
// (a^n / density)^2 in 2, 3 and 4 dimensions, mirrored 0.15 and 0.62 times in 3 and 4; 3.3, 3.8 and 4.4 times
// of a Poisson process. By Edgeworth's series there are 1 + 9.2 kurtosis + 2.6 kappa_6 times as many such
// values as a Gaussian field has: in 3D 1.25 of waves, one in each cube, in 4D 1.11 with a pair in each, or
// 1.27 with a kurtosis of 0.02; of isotropic kernels of an octave, a pair in each, 0.93 and 1.31, of half an
// octave to four 0.7 to 1.2 in 2D and 3D, where bands of more than 1.4 octaves have two pairs in each cube,
// for the place's sake, and up to 1.43 in 4D; one independent impulse in each would leave 1.84 of two octaves
// in 3D.
//
// Weights whose signs, or phases, are balanced in each cube would gain nothing: kappa_4 is of how the power,
// the sum of squared kernels, differs from place to place, and squares stay what they are; but impulses of
// one cube would correlate, and change the spectrum.

// Cubes with a number of impulses in each, which is even if they are mirrored.
struct Strata : Cubes {
  int count = 1;
};

// What strata are chosen by: the kernel of unlimited support, so that an error that is allowed for does not
// move impulses.
struct StrataChoice {
  int dimensions = 0;
  KernelMoments moments;  // of unlimited support
  WeightMoments weights;
  std::shared_ptr<const CubeAverages> averages;
  double radius = 0.0;               // that holds nearly all of a kernel, world units
  bool mirrored = false;             // impulses, in pairs
  std::optional<Strata> known = {};  // balanced(), where it has been found
  double kurtosis = kMeanKurtosis;   // that the mean over all places may have

  // Balanced cubes with the fewest impulses for which the excess kurtosis given the place is within
  // kPlaceKurtosis; or, where the mean may be more than kMeanKurtosis, the fewest for which both are within.
  // Where the mean alone takes more impulses than poisson_density(), as random directions in four dimensions
  // and the peaks of narrow bands of isotropic kernels do, as many, or one, or a pair, in each of the largest
  // cubes of a mean within kMeanKurtosis, at most kMostOverPoisson times.
  Strata fewest() const;

  // Cubes as near to balanced ones as whole numbers allow, of this density.
  Strata of_density(double density) const;

  // One impulse, or a pair, in each of the cubes in which the excess kurtosis is 0, whatever the density.
  Strata balanced() const { return balanced(mirrored); }

  // The same, with balanced() known.
  StrataChoice found() const;

  // How often cells have to be cut in halves along each axis to be these strata, which are one each or pieces
  // with one impulse, or one pair, each (ImpulseCount): so that cells are not smaller than smallest_cell().
  int halvings(const Strata& strata) const;

  // Positions are exact in single precision where a kernel is over less than 16 cells (CellAxis).
  double smallest_cell() const { return radius / 6.0; }

  static constexpr int kMostHalvings = 3;
  static constexpr double kWantedMean = 0.95 * kMeanKurtosis;  // compact kernels have up to a twentieth more
  static constexpr double kPlaceKurtosis = 0.25;
  static constexpr double kMostOverPoisson = 10.0;

  double density_of(const Strata& strata) const;

  // Of a Poisson process of excess kurtosis kDefaultKurtosis.
  double poisson_density() const;

  // Where the excess kurtosis of independent impulses is 0, whatever the density.
  double balanced_side() const { return balanced(false).side; }

 private:
  Strata balanced(bool in_pairs) const;
  Strata fewest_balanced() const;
  bool fits(const Strata& strata) const;
  double side_of(double density, int count) const;
  double excess_kurtosis(const Strata& strata) const;
  double given_place(const Strata& strata) const;
};

// Of isotropic Gabor kernels, of waves of random phase, of waves of phase 0 with random signs, and of kernels
// of one of these in the plane that are taken from a layer of a half thickness around it, under the square of
// a window of the distance in half thicknesses.
template <int Dim>
StrataChoice strata_choice(const IsotropicGaborKernel<Dim>& kernel, const WeightMoments& weights);
template <int Dim>
StrataChoice strata_choice(const RandomPhaseGaborKernel<Dim>& kernel);
template <int Dim>
StrataChoice strata_choice(const EvenGaborKernel<Dim>& kernel);
template <typename Kernel>
StrataChoice layer_strata_choice(const Kernel& in_plane, double half_thickness,
                                 const std::function<double(double)>& window);

// The side of cubes at which a fourth cumulant, which grows with it, is 0, to a thousandth of it; `least` if
// that is above 0 there, `most` if it is below.
double balanced_side(const std::function<double(double side)>& cumulant, double least, double most);

// How far the excess kurtosis at a place in the planes of cubes may be from its mean: at most twice the
// harmonics' sum, of which the first are taken, to a hundredth of it, of waves of phase 0 to a twentieth.
// Of these it is that of all directions together.
double kurtosis_given_place(double density, const KernelMoments& kernel, const CubeAverages& averages,
                            const Cubes& cubes);

}  // namespace solidnoise
