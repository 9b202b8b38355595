#pragma once

#include <cstdint>
#include <vector>

#include "solidnoise/analysis/dense_field.h"

namespace solidnoise::papers {

// A plane under noise that runs to the horizon (Lagae et al. 2011, figure 8), seen three times: a sample per
// pixel, the noise filtered in closed form for each row of pixels, and the mean of many samples per pixel,
// weighted by the same filter, which is what the closed form should give.
struct TiltedPlane {
  DenseField<2> sampled;
  DenseField<2> filtered;
  DenseField<2> averaged;
  std::vector<double> cycles_per_pixel;  // of the noise's frequency, along the view; per row from below
  std::vector<double> sampled_rms;       // per row
  std::vector<double> filtered_rms;
  std::vector<double> expected_rms;    // in closed form
  std::vector<double> difference_rms;  // of filtered and averaged
};

struct TiltedPlaneOptions {
  int columns = 256;
  int rows = 192;
  int samples = 12;  // along each side of the filter, for the average
  std::uint64_t seed = 3;
};

// The filter of a row is a Gaussian of half a pixel's footprint along the view, its longer side; round, as in
// the paper. The kernel is isotropic, and its filtered form exact, where the paper takes a Gaussian in its
// place.
TiltedPlane tilted_plane(const TiltedPlaneOptions& options);

}  // namespace solidnoise::papers
