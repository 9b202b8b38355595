#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"

namespace solidnoise::papers {

// The noises of Kensler, Knoll, Shirley 2008, figure 1, a to f, and what is added here. Lengths are in
// lattice units.
enum class GradientKind {
  chained,       // a: Perlin's with the classic hash
  xor_tables,    // b: with the exclusive-or of one table per axis
  wide,          // c: with the wide kernel
  slice,         // d: a plane across (1, 1, 1) through the 3D noise of c
  projected,     // e: the lattice projected on that plane
  half,          // f: the same of half the resolution
  wide_zero_dc,  // c, d and e with the kernel that has no power at frequency 0
  slice_zero_dc,
  projected_zero_dc,
};

struct GradientSampleSize {
  int side = 1024;     // samples; 256 lattice units, a full repetition of the tables
  double step = 0.25;  // lattice units
  std::uint64_t seed = 1;
};

// Values on the plane. With `step` 0.25 and 1024 samples noises of two dimensions repeat exactly.
DenseField<2> sample_gradient(GradientKind kind, const GradientSampleSize& size);

// The periodogram of the plane: without a window where it repeats, else with Hann's.
PowerSpectrum<2> gradient_spectrum(GradientKind kind, const DenseField<2>& field);

// The share of the power below a quarter of the frequency where the mean density over all directions is
// highest, and that frequency, in cycles per lattice unit.
struct BandLimit {
  double peak = 0.0;
  double low_share = 0.0;
};
BandLimit band_limit(const PowerSpectrum<2>& spectrum);

// How much neighbouring lines of the spectrum across an axis differ: the root mean square of their powers'
// differences over their sums, of the lines of the lower half of the lattice's frequencies. 0: along x, lines
// of constant frequency y.
double striation(const PowerSpectrum<2>& spectrum, int axis);

// Mean variance of projected noise over planes z = height, normal to z; of half resolution where `stride` is
// 2, with a window of this reach. By the printed pseudocode, for unit gradients.
double plane_variance(int stride, double height, double window_reach, int side, std::uint64_t seed);

}  // namespace solidnoise::papers
