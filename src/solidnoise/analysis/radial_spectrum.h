#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/analysis/periodogram.h"

namespace solidnoise {

// The frequencies between two spheres around 0, lower <= |f| < upper.
struct RadialBin {
  double lower = 0.0;
  double upper = 0.0;
  double frequency = 0.0;       // mean |f| of the discrete frequencies in it, cycles per unit
  std::int64_t count = 0;       // of those frequencies; f and -f are two
  double power = 0.0;           // mean density
  double standard_error = 0.0;  // of `power`, for a Gaussian field
};

// The mean over all directions in bins of `width` cycles per unit, from 0 to the lowest Nyquist frequency of
// the axes; empty bins are left out. Width 0 stands for 2 frequency steps (of the axis with the largest).
template <int Dim>
std::vector<RadialBin> radial_average(const PowerSpectrum<Dim>& spectrum, double width = 0.0);

struct ComparisonOptions {
  double width = 0.0;  // of the radial bins, cycles per unit; 0: 2 frequency steps

  // Impulses per world unit^Dim, divided by E[w^4] / E[w^2]^2 of their weights; 0: a Gaussian field. The
  // number of impulses in the data scatters, and with it the power of all frequencies together.
  double impulse_density = 0.0;

  // Relative RMS error e of the noise's kernel against the one whose spectrum is expected. Spectra S of
  // kernels that differ by e differ by some e sqrt(S S_max) + e^2 S_max, which is added to the standard
  // errors.
  double kernel_error = 0.0;

  double floor = 1e-4;          // bins below this fraction of the highest expected power do not count
  double largest_error = 0.15;  // bins of a larger relative standard error (too few frequencies) do not count
};

struct ComparedBin {
  RadialBin measured;     // its standard_error is derived from the expected spectrum
  double expected = 0.0;  // mean expected density in the bin
  bool counted = false;   // whether it is a part of chi_square

  double deviation() const { return (measured.power - expected) / measured.standard_error; }
};

struct SpectrumComparison {
  std::vector<ComparedBin> bins;
  double chi_square = 0.0;  // of the counted bins, with the correlation of neighbouring bins removed
  int degrees_of_freedom = 0;
  double significance = 1.0;  // probability of at least this chi_square, if the expected spectrum is right
};

// Compares a measured spectrum with what was expected of it (expected_periodogram(), same count, step and
// window; else throws std::invalid_argument). Periodogram values of a Gaussian field are exponentially
// distributed; those a window's width apart correlate by the square of the window's own spectrum, which the
// standard errors and chi_square take into account.
template <int Dim>
SpectrumComparison compare_spectra(const PowerSpectrum<Dim>& measured, const PowerSpectrum<Dim>& expected,
                                   const ComparisonOptions& options = {});

// Probability that a chi-square variable of k degrees of freedom is at least x, by the cube-root
// approximation of Wilson and Hilferty (1931); its error is below 0.002 for k >= 3, and relative errors grow
// in the far tail.
double chi_square_significance(double x, int k);

}  // namespace solidnoise
