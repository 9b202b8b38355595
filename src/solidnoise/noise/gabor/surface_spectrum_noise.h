#pragma once

#include <array>
#include <span>
#include <vector>

#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/point/point_parameters.h"

namespace solidnoise {

// A two-dimensional noise by example on surfaces, without a parametrisation (Galerne et al. 2012, section 6):
// as SurfaceGaborNoise, with kernels whose waves are drawn from a spectrum. With u the tangent at a point of
// unit normal n and o, x, y the parts of the offset x - X_i along n, u and n cross u,
//   noise(x, n, u) = sum of W_i h(o / H) envelope(x, y) cos(2 pi (w_i.x x + w_i.y y)),
// impulses X_i from a layer of half thickness H around the tangent plane. On a plane its spectrum is that of
// the model, turned so that the exemplar's first axis lies along u; values have unit variance.
//
// Unlike SpectrumNoise, kernels have no random phase but random signs, so that u and -u give the same noise:
// no field of directions without poles has signs that agree everywhere. A kernel's weight makes up for what a
// fixed phase does to its energy; the spectrum of components within their own width of frequency 0 is a
// little narrower than the model's.
//
// With options.filter it is that noise convolved with a Gaussian along the plane: the same impulses, as
// SpectrumNoise is in space.
//
// Bands of long waves have thick layers, `layer` radii of their kernels: where the surface curves more than
// that, they are distorted, see SurfaceGaborNoise. A value depends on the point's position, normal and
// tangent only. Immutable; may be shared between threads.
class SurfaceSpectrumNoise {
 public:
  // `layer`: half the layer's thickness, in kernel radii, 0.1 to 1. Throws std::invalid_argument:
  // options.validate(), a spectrum that is not of 2 dimensions, a period, which it cannot have.
  SurfaceSpectrumNoise(const SpectrumNoiseOptions& options, double layer);
  ~SurfaceSpectrumNoise();
  SurfaceSpectrumNoise(SurfaceSpectrumNoise&&) noexcept;

  // Of unit variance, or what the filter leaves of that; if that is nothing, all of it. Cycles per world
  // unit.
  const GaborSpectrum& spectrum() const { return spectrum_; }
  double variance() const { return variance_; }
  double impulses_per_kernel() const { return impulses_; }     // N, mean
  double excess_kurtosis() const { return excess_kurtosis_; }  // at most, without a filter
  // As SpectrumNoise's.
  double kurtosis_given_place() const { return solidnoise::kurtosis_given_place(shares_, densities_); }

  // One sample per point; the gradient is as that of SurfaceGaborNoise. `tangent` of any length but 0, laid
  // into the tangent plane; either sign. Throws std::invalid_argument as SurfacePoints::validate does, and
  // where sizes differ.
  void evaluate(const SurfacePoints& points, const std::array<std::span<const float>, 3>& tangent,
                const Samples<3>& samples) const;

  Noise<2>::Band band() const;  // the frequencies that hold all but a thousandth of the variance

 private:
  class Band;

  GaborSpectrum spectrum_;
  double variance_ = 0.0;
  double impulses_ = 0.0;
  double excess_kurtosis_ = 0.0;
  std::vector<BandShare> shares_;
  std::vector<double> densities_;  // of the bands' strata
  std::vector<Band> bands_;
};

}  // namespace solidnoise
