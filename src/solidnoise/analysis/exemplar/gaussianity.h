#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solidnoise/analysis/dense_field.h"

namespace solidnoise {

// How far a texture is from a Gaussian one, which is all that noise can be: its spectrum says everything
// about a Gaussian texture, while in a structured one (bricks, leaves) the phases matter.
struct GaussianityReport {
  double skewness = 0.0;         // of the values; 0 for a Gaussian texture
  double excess_kurtosis = 0.0;  // of the values; 0
  // Excess kurtosis of the differences between samples at a distance, less that of the texture's own Gaussian
  // versions, for the distance at which it is largest: rare strong edges make it large, phases at random do
  // not. 0 for a Gaussian texture.
  double structure = 0.0;
  int structure_distance = 1;  // samples
  double significance = 0.0;   // of `structure`, in standard deviations of that of the Gaussian versions
  // What to tell the user, a line each; empty for a texture that noise can match.
  std::vector<std::string> warnings;
};

// Compares a field with `versions` of its Gaussian versions (gaussian_version).
GaussianityReport test_gaussianity(const DenseField<2>& field, int versions = 8, std::uint64_t seed = 0);

}  // namespace solidnoise
