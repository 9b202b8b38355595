#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// Noise is symmetric about its mean; photographs of lawns or gravel, dark with bright parts, are not. Their
// square roots nearly are: noise that is learnt from those and squared is as lopsided, and never below 0.

// Each value as its square root, 0 where it is negative.
template <int Dim>
std::vector<Exemplar<Dim>> square_roots(std::span<const Exemplar<Dim>> exemplars);

// Each value as its square.
Exemplar<2> squared(Exemplar<2> exemplar);

// The best that squares of noise can do: those of the Gaussian version of an exemplar's roots.
Exemplar<2> squared_version(const Exemplar<2>& exemplar, std::uint64_t seed);

// What the noise u of a mean and a variance must have, so that u^2 has these: of a normal distribution
//   E[u^2] = m^2 + s^2,   Var[u^2] = 2 s^4 + 4 m^2 s^2.
// Values whose variance is above twice their mean's square are more lopsided than any square: they get the
// mean and less variance. Both are 0 for a mean that is not above 0.
struct RootMoments {
  double mean = 0.0;
  double variance = 0.0;
};
RootMoments root_moments(double mean, double variance);
// The share of the variance that squares reach: 1 but for such values.
double reached_share(double mean, double variance);

// Makes a model's colours the squares of what they are, and moves its mean and axes so that they have these
// means and covariances (eq. above, and Cov[u^2, v^2] = 2 c^2 + 4 m_u m_v c of normal u and v of covariance
// c), the share of these that is reached: those of the exemplars whose roots it was fitted to.
void square_colors(ExemplarModel& model, const SampleMoments& wanted);

}  // namespace solidnoise
