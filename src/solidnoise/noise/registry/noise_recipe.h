#pragma once

#include <cstdint>
#include <memory>
#include <variant>

#include "solidnoise/noise/cellular/cellular_noise_options.h"
#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Everything that defines a noise: plain data. One more noise is one more alternative here.
struct NoiseRecipe {
  std::variant<GaborNoiseOptions, OrientedGaborNoiseOptions, GradientNoiseOptions, SpectrumNoiseOptions,
               CellularNoiseOptions>
      noise{};
  FractalOptions fractal{};

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const NoiseRecipe&, const NoiseRecipe&) = default;
};

// Of the noise itself; octaves have seeds made from it.
std::uint64_t seed_of(const NoiseRecipe& recipe);

// World units along each axis; 0 where there is none.
Vec<4> period_of(const NoiseRecipe& recipe);

// Changes whenever any noise's values do, for the same recipe; stored in every file that is written.
inline constexpr int kAlgorithmVersion = 22;

// The error that a recipe allows against the noise of kernels of infinite support, relative to its standard
// deviation: the `error` of its options, which ErrorBudget splits; 0 for noises without kernels to truncate.
double error_of(const NoiseRecipe& recipe);

// Octave k of a recipe as a noise by itself, of unit variance: what the recipe's noise sums. k is at least 0.
NoiseRecipe octave_of(const NoiseRecipe& recipe, int k);

// How the noise evolves; null for a noise that cannot.
Evolution* evolution_of(NoiseRecipe& recipe);
const Evolution* evolution_of(const NoiseRecipe& recipe);
bool evolves(const NoiseRecipe& recipe);

// The recipe of the noise as it is at a time; the same recipe where the noise does not evolve.
NoiseRecipe at_time(const NoiseRecipe& recipe, double time);

// The recipe of the noise convolved with a Gaussian of this standard deviation, world units, too
// (gaussian_filter.h). Gabor noises can be, but for those by example; throws std::invalid_argument for
// others.
bool can_filter(const NoiseRecipe& recipe);
NoiseRecipe filtered(const NoiseRecipe& recipe, double deviation);

// The recipe of a noise that is alike but independent, another one for each channel (0, 1, ...): of the same
// options, also the period, with a seed that is a hash of the recipe's and the channel. For vectors and
// colours; none of the channels is the recipe's own noise. Of a noise by example, channel k has the spectrum
// of the model's channel k, if it has that many.
NoiseRecipe channel_of(const NoiseRecipe& recipe, int channel);

// The same noise, its gradient within the recipe's error too (bounds_gradient), where it is made of kernels.
NoiseRecipe bounding_gradient(const NoiseRecipe& recipe);

// Makes the noise, its kernels within their share of the recipe's error (ErrorBudget), of unit variance
// unless the recipe's octaves are not renormalised or the noise is filtered (octaves of which the filter
// leaves nothing cost nothing). Dim is 1 to 4. Throws std::invalid_argument.
template <int Dim>
std::unique_ptr<Noise<Dim>> make_noise(const NoiseRecipe& recipe);

// Throws std::invalid_argument unless the recipe is of oriented Gabor noise of one octave.
void require_phase(const NoiseRecipe& recipe);

// Makes the noise that is a quarter of a wave behind the recipe's: the same impulses with sin in place of
// cos. The two are the real and the imaginary part of a phasor,
//   sum over impulses of envelope(d) exp(i (2 pi w.d + phase))
// (Tricard et al. 2019), and have the same statistics. Throws std::invalid_argument as require_phase does.
template <int Dim>
std::unique_ptr<Noise<Dim>> make_quadrature(const NoiseRecipe& recipe);

// Which generator makes an isotropic noise. Noise of all directions alike can be made by isotropic kernels or
// by oriented ones in random directions and with random phases: of the same frequency and bandwidth, their
// spectra are rings of the same place and width that differ a little in shape (|G|^2 is I_nu(x)^2 for one and
// I_nu(2 x) for the other, times Gaussians). An isotropic kernel gathers its energy in a central spike, the
// more so the more dimensions there are and the narrower the band, and needs more impulses for the same
// likeness to a Gaussian field. By default, without excess kurtosis (0.02 in the first line from three
// dimensions on, and of random directions in four), isotropic kernels and random directions:
//   dimensions        1         2           3             4
//   0.3 octaves     5,  5    45,  9     983, 19     9783, 44
//   1 octave        5,  5    23,  9      53, 19      204, 44
//   2 octaves       4,  5    17,  9      33, 19       46, 44
//   4 octaves       5,  5    12,  9      10, 19       15, 44
//
// There is a choice for isotropic Gabor noise, but for weights in [-1, 1], which random phases have no use
// for, and for oriented Gabor noise without anisotropy.
bool has_generators(const NoiseRecipe& recipe);

// Returns the recipe of the same noise, made by the generator that is cheaper at the same excess kurtosis (at
// the same number of impulses, where the recipe says one) and the same error: the one with less of impulses
// per kernel times the cost of an impulse. Where there is no choice, the recipe as it is. The two are
// different noises for the same seed. Dimensions 1 to 4. Throws std::invalid_argument for options that are
// not valid.
NoiseRecipe cheapest_generator(const NoiseRecipe& recipe, int dimensions);

}  // namespace solidnoise
