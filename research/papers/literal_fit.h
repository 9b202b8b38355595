#pragma once

#include <vector>

#include "solidnoise/analysis/periodogram.h"

namespace solidnoise::papers {

// A sparse decomposition of a spectrum, as far as the two ways to read eq. 8 of Galerne et al. 2012 differ.
struct BandCounts {
  std::vector<int> components;  // of each band, the widest first
  double residual = 0.0;        // |spectrum - periodogram| / |periodogram|
};

// What the penalty is the sum of: the squared magnitudes K^2 of the kernels, as eq. 8 has it, where an atom
// of a band half as wide is 8 times as long; or the lengths of the atoms, as the library takes it.
enum class Penalty { squared_magnitudes, lengths };

// Minimizes |S x - y|^2 + kappa nu_max (penalty of x) over x >= 0, along kappa = 1/2, 1/4, ..., with all
// bands down to the one of a single frequency. The periodogram is square and its side a power of 2, at
// least 16. Components are those above a thousandth of the largest.
BandCounts fit_bands(const PowerSpectrum<2>& periodogram, double kappa, Penalty penalty, int iterations);

}  // namespace solidnoise::papers
