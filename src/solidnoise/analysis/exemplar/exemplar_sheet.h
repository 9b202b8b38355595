#pragma once

#include <cstdint>
#include <string>

#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

struct ExemplarSheetOptions {
  std::string title = {};    // above the panels
  std::string caption = {};  // below them
  std::uint64_t seed = 1;    // of the textures; they are others than the exemplar
  double black = 0.0;        // the values shown as black and as white
  double white = 1.0;
};

inline constexpr int kLargestShown = 512;  // pixels of an exemplar along an axis

// The picture by which a noise by example is judged (Galerne et al. 2012, figure 4), side by side at the
// exemplar's own size: the exemplar; its Gaussian version, which is the best that noise can do; the Gaussian
// texture of the sparse spectrum, which shows what the decomposition lost; the procedural noise, which shows
// what impulses add. Each with its power spectrum as an inset, frequency 0 in the middle, in logarithmic
// brightness: periodograms, and the sparse spectrum itself in the third. Exemplars of under 200 pixels are
// enlarged, large ones cut to kLargestShown. For an isotropic or oriented noise in 3D, which has no sparse
// spectrum in 2D, the third panel shows another slice of the noise. Returns sRGB-encoded pixels, 3 channels.
// Throws Cancelled.
Image draw_exemplar_sheet(const Exemplar<2>& exemplar, const ExemplarModel& model,
                          const ExemplarSheetOptions& options = {}, Progress* progress = nullptr);

// The colours of the model's procedural noise on a grid of samples from `origin` on; of a noise in 3D, its
// slice across the third axis there. Not encoded. Throws Cancelled.
Exemplar<2> procedural_texture(const ExemplarModel& model, const glm::ivec2& count, const Vec<2>& step,
                               const Vec<3>& origin, std::uint64_t seed, Progress* progress = nullptr);

}  // namespace solidnoise
