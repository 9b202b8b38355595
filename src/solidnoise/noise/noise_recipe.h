#pragma once

#include <cstdint>
#include <memory>
#include <variant>

#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Everything that defines a noise: plain data. One more noise is one more alternative here.
struct NoiseRecipe {
  std::variant<GaborNoiseOptions, OrientedGaborNoiseOptions, GradientNoiseOptions, SpectrumNoiseOptions>
      noise;
  FractalOptions fractal;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const NoiseRecipe&, const NoiseRecipe&) = default;
};

// Of the noise itself; octaves have seeds made from it.
std::uint64_t seed_of(const NoiseRecipe& recipe);

// Changes whenever any noise's values do, for the same recipe; stored in every file that is written.
inline constexpr int kAlgorithmVersion = 4;

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

}  // namespace solidnoise
