#pragma once

#include <cstdint>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/periodogram.h"

namespace solidnoise::papers {

// Perlin's noise and Gabor noise of two dimensions, whose spectra have their maxima at the same frequency, on
// `side` x `side` samples of `seeds` seeds (Lagae et al. 2011, figure 7, without wavelet noise).
struct NoiseComparison {
  DenseField<2> perlin;  // of the first seed
  DenseField<2> gabor;
  PowerSpectrum<2> perlin_spectrum;  // means
  PowerSpectrum<2> gabor_spectrum;
};
NoiseComparison compare_with_perlin(int side, int seeds);

// How much the power of a spectrum depends on the direction: of the frequencies from `lower` to `upper`, that
// within 15 degrees of the diagonals over that within 15 degrees of the axes. 1 for isotropic noise.
double diagonal_over_axis(const PowerSpectrum<2>& spectrum, double lower, double upper);

}  // namespace solidnoise::papers
