#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/analysis/exemplar/fit_spectrum.h"

namespace solidnoise {

struct ExemplarFitOptions {
  SpectrumFitOptions spectrum;
  ColorAxes axes = ColorAxes::independent;
  // Gives weaker channels a larger kappa, in proportion to the deviation of the strongest, up to 1/64: what
  // is hardly seen needs fewer components. Otherwise (the paper) all have spectrum.kappa.
  bool weigh_channels = true;
  int patch = 0;            // samples; 0: as large as the smallest exemplar
  bool raw_values = false;  // only noted in the model: values are not linear light
  bool squares = false;  // learns the values' square roots; the noise's colours are squares (square_colors.h)

  // Throws std::invalid_argument.
  void validate() const;
};

template <int Dim>
struct ExemplarFit {
  ExemplarModel model;
  std::vector<SpectrumFit> channels;          // their spectra are the model's, without groups
  std::optional<ColorDependence> dependence;  // of exemplars in colour
  glm::vec<Dim, int> count{1};                // of a patch
  int patches = 0;
  bool interrupted = false;
};

// A noise from exemplars (Galerne et al. 2012): their spectra in the colour space of choice, each decomposed
// into a sparse sum of Gaussians and grouped after Wold. In 2D, where the spectrum's fine detail is filled
// in, each ring of frequencies has the exemplar's power (match_rings). A channel has the variance of the
// samples. With options.squares all this is of the samples' square roots, but for means and covariances of
// colours, which are the samples' own. Where `progress` asks to stop, channels are kept as far as they are;
// where it asks before any is begun, while pictures are measured, Cancelled is thrown. Throws
// std::invalid_argument for bad options and for exemplars that do not agree.
template <int Dim>
ExemplarFit<Dim> fit_exemplar(std::span<const Exemplar<Dim>> exemplars,
                              const ExemplarFitOptions& options = {}, Progress* progress = nullptr);

}  // namespace solidnoise
