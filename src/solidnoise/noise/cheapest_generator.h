#pragma once

#include "solidnoise/noise/noise_recipe.h"

namespace solidnoise {

// Which generator makes an isotropic noise. Noise of all directions alike can be made by isotropic kernels or
// by oriented ones in random directions and with random phases: of the same frequency and bandwidth, their
// spectra are rings of the same place and width that differ a little in shape (|G|^2 is I_nu(x)^2 for one and
// I_nu(2 x) for the other, times Gaussians). An isotropic kernel gathers its energy in a central spike, the
// more so the more dimensions there are and the narrower the band, and needs more impulses for the same
// likeness to a Gaussian field. For an excess kurtosis of 0.5 at an error of 2 %, isotropic kernels and
// random directions:
//   dimensions        1         2          3            4
//   0.3 octaves     7,  7    47, 12    446, 22    2921, 40
//   1 octave        7,  7    28, 12     93, 22     241, 40
//   2 octaves       7,  7    21, 12     43, 22      74, 40
//   4 octaves       8,  7    16, 12     13, 22      25, 40
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
