#pragma once

#include "solidnoise/core/check.h"

namespace solidnoise {

// A sparse convolution noise is the sum of kernels g at the points of a Poisson process, each with a random
// weight W of mean 0, independent of all others:
//   noise(x) = sum of W_i g(x - x_i);   density: mean impulses per unit of n-dimensional volume.
// By Campbell's theorem its k-th cumulant is density E[W^k] times the integral of g^k (Lagae et al. 2011,
// eqs. 14 to 17, for the second). Where the kernel itself is random, as with a random phase, use its mean
// integrals, and weights of 1.

// Numbers of impulses are those in the ball outside of which a kernel of unlimited support has this relative
// RMS error: they do not change with the error that is asked for.
inline constexpr double kNominalError = 0.02;

// Mean impulses per unit volume, for `impulses` mean impulses in a ball of a radius > 0, in n dimensions; and
// back.
double impulse_density(int n, double impulses, double radius);
double impulses_in_ball(int n, double density, double radius);

// How an impulse of isotropic Gabor noise is weighted. Both have mean 0; `signs` is nearer to a Gaussian
// field at the same number of impulses, `uniform` is what the papers use.
enum class ImpulseWeights { signs, uniform };

// How impulses are spread over space: in strata, the same number of them in every cube (Strata), or as a
// Poisson process, whose numbers of impulses vary at random, as in the papers.
enum class ImpulseSpread { strata, poisson };

// Moments of an impulse's weight; by default those of weights that are 1 or -1.
struct WeightMoments {
  double second = 1.0;  // E[W^2]
  double fourth = 1.0;  // E[W^4]
};
WeightMoments weight_moments(ImpulseWeights weights);  // uniform on [-1, 1]: 1/3 and 1/5

// Of weights times sqrt(2) cos(2 pi a), a uniform: those of weights that turn with time (Evolution). The
// second moment stays, the fourth is 3/2 of what it was.
WeightMoments turning(const WeightMoments& weights);

// Integrals of powers of a kernel over space.
struct KernelMoments {
  double second = 0.0;  // of g^2: energy()
  double fourth = 0.0;  // of g^4: fourth_moment()
  // Of impulses in strata, CubeAverages::overlap(): how much less random they are; 0 for a Poisson process.
  double overlap = 0.0;
};

// Variance of the noise. Put |G(f)|^2, or the kernel's autocorrelation, in place of the integral of g^2 and
// it is the power spectrum, or the covariance.
double noise_variance(double density, double energy, const WeightMoments& weights = {});

// How far from Gaussian the noise is: E[noise^4] / E[noise^2]^2 - 3. With the same overlap inversely
// proportional to the density.
double noise_excess_kurtosis(double density, const KernelMoments& kernel, const WeightMoments& weights = {});

// The density at which the noise of a Poisson process has a given excess kurtosis > 0.
double density_for_excess_kurtosis(double kurtosis, const KernelMoments& kernel,
                                   const WeightMoments& weights = {});

// That a Poisson process has by default, and what strata may leave; and the range of what they may be asked
// to.
inline constexpr double kDefaultKurtosis = 0.5;
inline constexpr double kMeanKurtosis = 0.02;
inline constexpr Interval kKurtosis = between(kMeanKurtosis, kDefaultKurtosis);

}  // namespace solidnoise
