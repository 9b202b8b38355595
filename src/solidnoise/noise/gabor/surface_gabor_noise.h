#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/impulse_strata.h"
#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/point/point_convolution.h"
#include "solidnoise/noise/point/point_parameters.h"
#include "solidnoise/noise/point/scale_layout.h"

namespace solidnoise {

// Parameters of Gabor noise on surfaces.
struct SurfaceGaborOptions {
  double frequency = 8.0;        // principal frequency F0, cycles per world unit; > 0
  double bandwidth = 1.0;        // width of the band at half amplitude, octaves; 0.1 to 4
  double error = 0.02;           // relative RMS error against the kernel of infinite support; 1e-4 to 0.5
  bool bounds_gradient = false;  // whether the gradient's error is within `error`, too, relative to itself
  double impulses = 0.0;         // mean impulses under one kernel, N; 0: the fewest that look Gaussian
  ImpulseSpread impulses_process = ImpulseSpread::strata;
  // Mean excess kurtosis that strata may leave, where their number of impulses is chosen; 0.02 to 0.5.
  double kurtosis = kMeanKurtosis;
  GaborWaves waves = GaborWaves::isotropic;
  Vec<3> direction{1.0, 0.0, 0.0};  // of oriented waves, laid into the tangent plane; any length but 0
  // Half the thickness of the layer that impulses are taken from, in kernel radii at an error of 0.02; 0.1
  // to 1. A pattern is distorted by curvature in proportion to the layer's thickness over the radius of
  // curvature, and impulses are made in inverse proportion to it.
  double layer = 0.5;
  std::uint64_t seed = 0;
  // World units: frequencies that vary take their impulses from grids whose sides are this times a power of
  // two (ScaleFade), so that the noise of what is as much larger, at frequencies as much lower, is the same.
  double unit = 1.0;
  Evolution evolution{};  // how it changes with time; by default it does not
  double filter = 0.0;  // standard deviation of a Gaussian that it is convolved with along the surface, world
                        // units; 0: none

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const SurfaceGaborOptions&, const SurfaceGaborOptions&) = default;
};

// Gabor noise on surfaces, without a parametrisation. With X_i random points in space and
// W_i weights of 1 or -1, at a point x with unit normal n,
//   noise(x, n) = sum of W_i h(o_i / H) g(p_i),   o_i = (x - X_i).n,   p_i = (x - X_i) - o_i n:
// impulses are taken from a layer of half thickness H around the tangent plane and projected on it. g is a
// two-dimensional Gabor kernel of radius r in the tangent plane, isotropic or oriented, h the window of
// PointConvolution. On a plane of any orientation it is two-dimensional Gabor noise, exactly: its spectrum is
// |G(f)|^2 up to a factor, a true band, which no slice of an isotropic solid noise has. By Campbell's theorem
// the variance is the same everywhere, whatever the normal and the curvature; values are scaled to a standard
// deviation of 1 (or of the magnitude at the point).
//
// After the surface noise of Lagae et al. 2009 and 2011, section V (figure 16), with these differences: the
// normalisation accounts for the window; kernels are compact (KernelFamily) and without random phase, so that
// an oriented noise needs a direction at each point but no sign of it; the transition of scales is
// ScaleFade.
//
// Where the curvature is strong a pattern is stretched or compressed by up to H times the curvature; keep H
// (options.layer times radius()) below 0.3 radii of curvature. A sheet thinner than H has related patterns on
// both sides.
//
// Directions of a point may be shorter than 1: the waves of an oriented kernel then are longer by as much, in
// the same envelope, until at 0 the envelope is left, which has no direction. A field of directions that
// turn around a point so has one value there, and a gradient like the noise's own around it. Our own; of a
// direction of the options the length says nothing.
//
// With options().filter it is that noise convolved with a Gaussian along the plane, as GaborNoise is in
// space: the same impulses with the filtered kernel of each point.
//
// The gradient is a vector along the surface, with normal and parameters of the point held fixed: on a plane
// the analytic derivative of the value, as far as the parameters are the same all around. Where the surface
// curves, the turning of the normal moves the pattern by up to H times the curvature more.
//
// A value depends on the point's position, normal and parameters only, not on the other points (vector widths
// without fused multiply-add may differ in the last bits). Immutable; may be shared between threads: give
// each thread points that are near each other, some ten thousand at a time.
class SurfaceGaborNoise {
 public:
  // Throws std::invalid_argument: options.validate().
  explicit SurfaceGaborNoise(const SurfaceGaborOptions& options);

  const SurfaceGaborOptions& options() const { return options_; }
  double radius() const;                                    // of the options' kernel, world units
  double impulses_per_kernel() const { return impulses_; }  // N, mean

  // One sample per point. Throws std::invalid_argument naming the first point whose position is not finite or
  // whose normal has no direction, and what VaryingParameters::validate() does. If neither frequency nor
  // bandwidth vary it is a stationary noise, times magnitude and with the directions given; if they do, it
  // has other impulses, in a hierarchy of grids, and differs from that even where the parameters agree.
  void evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                const Samples<3>& samples) const;

  // 1, or of the options' kernel what the filter leaves.
  double variance() const { return filtered_ ? filtered_->variance : 1.0; }
  // E[value^4] / E[value^2]^2 - 3, of the options' kernel.
  double excess_kurtosis() const { return excess_kurtosis_; }
  // How far that may be from its mean at a place in the planes of strata; 0 of a Poisson process.
  double kurtosis_given_place() const;
  // The three where frequency or bandwidth vary: impulses that count (ScaleLayout), the mean over
  // frequencies, and the most of all.
  double varying_impulses_per_kernel() const { return support_ * scales_.effective_density(); }
  double varying_excess_kurtosis() const { return varying_excess_kurtosis_; }
  double varying_kurtosis_given_place() const { return scales_.kurtosis_given_place(choice_); }
  // The frequencies that hold all but a thousandth of the variance, without a filter.
  Noise<2>::Band band() const;

 private:
  SurfaceGaborOptions options_;
  std::shared_ptr<const KernelFamily> family_;
  KernelFamily::Member kernel_;                     // of the options, without a filter
  std::optional<KernelFamily::Filtered> filtered_;  // with one
  double impulses_ = 0.0;
  double support_ = 0.0;  // the volume in which they are counted, world units^3
  double excess_kurtosis_ = 0.0;
  StrataChoice choice_;
  double density_ = 0.0;
  Cubes cubes_;  // of strata; of side 0 if there are none
  double varying_excess_kurtosis_ = 0.0;
  ScaleLayout scales_;           // of impulses in a hierarchy of grids
  double scale_in_radii_ = 1.0;  // that these follow
  std::shared_ptr<const PointConvolution<3>> stationary_;
  std::shared_ptr<const PointConvolution<3>> varying_;
};

}  // namespace solidnoise
