#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "solidnoise/core/field.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/noise/point/point_convolution.h"
#include "solidnoise/noise/point/point_parameters.h"

namespace solidnoise {

// Parameters of Gabor noise whose parameters may vary from place to place: what holds where nothing else is
// given.
struct VaryingGaborOptions {
  double frequency = 8.0;        // principal frequency F0, cycles per world unit; > 0
  double bandwidth = 1.0;        // width of the band at half amplitude, octaves; 0.1 to 4
  double error = 0.02;           // relative RMS error against the kernel of infinite support; 1e-4 to 0.5
  bool bounds_gradient = false;  // whether the gradient's error is within `error`, too, relative to itself
  double impulses = 0.0;         // mean impulses under one kernel, N; 0: the fewest that look Gaussian
  ImpulseSpread impulses_process = ImpulseSpread::strata;
  // Mean excess kurtosis that strata may leave, where their number of impulses is chosen; 0.02 to 0.5.
  double kurtosis = kMeanKurtosis;
  GaborWaves waves = GaborWaves::isotropic;
  Vec<4> direction{1.0, 0.0, 0.0, 0.0};  // of oriented waves, the first axes of it; any length
  std::uint64_t seed = 0;
  // World units: frequencies that vary take their impulses from grids whose sides are this times a power of
  // two (ScaleFade), so that the noise of what is as much larger, at frequencies as much lower, is the same.
  double unit = 1.0;
  Evolution evolution{};  // how it changes with time; by default it does not
  double filter = 0.0;    // standard deviation of a Gaussian that it is convolved with, world units; 0: none

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const VaryingGaborOptions&, const VaryingGaborOptions&) = default;
};

// Gabor noise in Dim dimensions, 3 or 4, with a frequency, bandwidth, magnitude and direction of its own at
// each point (Lagae et al. 2011, section V). With X_i random points and W_i weights of 1 or
// -1,
//   noise(x) = sum of W_i g(x - X_i; parameters at x),
// g a Gabor kernel scaled so that the sum of its squares is right: the variance at x is the square of the
// magnitude at x, exactly, for any fields of parameters. Where these are constant the spectrum is that of a
// noise with these parameters; continuous fields give a continuous noise.
//
// Differences from the paper: kernels are compact and their variance exact (KernelFamily); their radius
// follows from a relative error in place of a fraction of the envelope; the transition of scales is ours
// (ScaleFade); oriented kernels have phase 0, so that a direction needs no sign.
//
// With options().filter it is that noise convolved with a Gaussian, as GaborNoise is: the same impulses with
// the filtered kernel of each point.
//
// The gradient is the analytic one of the sum with the parameters of the point held fixed: exact where they
// are the same all around, and otherwise without what their own change brings, which is small where they vary
// little across a kernel.
//
// A value depends on the point's position and parameters only, not on the other points (vector widths without
// fused multiply-add may differ in the last bits). Immutable; may be shared between threads: give each thread
// points that are near each other, some ten thousand at a time.
template <int Dim>
class VaryingGaborNoise {
 public:
  // Throws std::invalid_argument: options.validate().
  explicit VaryingGaborNoise(const VaryingGaborOptions& options);

  const VaryingGaborOptions& options() const { return options_; }
  double impulses_per_kernel() const { return impulses_; }  // N, mean
  // Of the kernel of a frequency > 0 and a bandwidth of 0.1 to 4 octaves, in world units.
  double radius(double frequency, double bandwidth) const;

  // One sample per point. Throws std::invalid_argument: parameters.validate(), or a position that is not
  // finite. If neither frequency nor bandwidth vary, all impulses are in one grid, which is the fastest; if
  // they do, in a hierarchy of grids, and the noise is another one even where the parameters agree.
  void evaluate(const Points<Dim>& points, const VaryingParameters<Dim>& parameters,
                const Samples<Dim>& samples) const;

  // E[value^4] / E[value^2]^2 - 3 of the noise with the parameters of the options.
  double excess_kurtosis() const { return excess_kurtosis_; }
  // The excess kurtosis where frequency or bandwidth vary, the mean over frequencies (ScaleLayout).
  double varying_excess_kurtosis() const { return varying_excess_kurtosis_; }

 private:
  VaryingGaborOptions options_;
  std::shared_ptr<const KernelFamily> family_;
  KernelFamily::Member kernel_;                     // of the options, without a filter
  std::optional<KernelFamily::Filtered> filtered_;  // with one
  double impulses_ = 0.0;
  double excess_kurtosis_ = 0.0;
  double scale_in_radii_ = 1.0;  // that impulses of the hierarchy follow
  double varying_excess_kurtosis_ = 0.0;
  std::shared_ptr<const PointConvolution<Dim>> stationary_;
  std::shared_ptr<const PointConvolution<Dim>> varying_;
};

}  // namespace solidnoise
