#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// Density of a slice through an isotropic noise in 3D whose only component has variance 1, frequency F and
// bandwidth a: the integral over t of the 3D density at sqrt(f^2 + t^2).
double slice_density(double f, double frequency, double a);

struct SolidFit {
  GaborSpectrum spectrum;  // isotropic, in 3D
  int components = 0;
  double residual = 0.0;  // of the slices' radial spectrum, relative
  // The least residual that any isotropic solid noise can have: the spectrum of a slice is an Abel transform
  // of a density that is not negative, which no band-pass spectrum is (it keeps low frequencies).
  double attainability = 0.0;
  double anisotropy = 0.0;  // largest difference of a direction's power from the mean of all, relative
  // What to tell the user, a line each: where slices will not look like the exemplar.
  std::vector<std::string> warnings;
};

// A solid noise whose slices look like an isotropic exemplar (not in the papers): an isotropic mixture in 3D
// for the radial average of a periodogram, by the same non-negative basis pursuit denoising over the slices'
// spectra. The variances sum to `variance`. Throws std::invalid_argument for a kappa outside of 1e-6 to 1 and
// for a spectrum without any power. Where `progress` asks to stop it throws Cancelled.
SolidFit fit_solid_spectrum(const PowerSpectrum<2>& periodogram, double variance, double kappa = 1.0 / 256.0,
                            Progress* progress = nullptr);

struct SolidExemplarFit {
  ExemplarModel model;
  std::vector<SolidFit> channels;
  std::optional<ColorDependence> dependence;
  glm::ivec2 count{1};
  int patches = 0;
};

// The same for the channels of exemplars in the plane, as fit_exemplar has them; of the spectrum's options
// kappa is looked at.
SolidExemplarFit fit_solid_exemplar(std::span<const Exemplar<2>> exemplars,
                                    const ExemplarFitOptions& options = {}, Progress* progress = nullptr);

}  // namespace solidnoise
