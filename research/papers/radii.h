#pragma once

namespace solidnoise::papers {

// The numbers of Lagae et al. 2011, sections III-C and IV-B, for the kernels of paper_kernel.h in two
// dimensions: radii in pixels, shares as fractions. Each is what the rule that the paper states gives; where
// the paper printed something else, `as_printed` holds what its number really is.
struct Radii {
  // Section III-C: where the envelope is 5 % of the kernel's maximum.
  double anisotropic_envelope = 0.0;
  double isotropic_envelope = 0.0;          // by the asymptotic envelope, eq. 52
  double isotropic_envelope_exact = 0.0;    // by the envelope itself
  double isotropic_envelope_printed = 0.0;  // with K left out of the maximum
  double printed_share_of_maximum = 0.0;    // where the printed radius really is, of the maximum
  // Section IV-B: where the relative error is 2 %.
  double anisotropic_error = 0.0;        // of phase 0, whose cosine squared is 1/2 (1 + J0) on average
  double random_phase_error = 0.0;       // of a random phase: the Gaussian alone
  double isotropic_error = 0.0;          // eq. 23 with the r^(n-1) of a volume integral
  double isotropic_error_printed = 0.0;  // eq. 23 as printed, without it
};
Radii example_radii();

// Fewer impulses for a radius smaller by so much, at the same density: 1 - (small / large)^2.
double saving(double small, double large);

}  // namespace solidnoise::papers
