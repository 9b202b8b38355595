#pragma once

#include <memory>
#include <span>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/interpolation/coarse_samples.h"
#include "solidnoise/noise/interpolation/interpolate_points.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/noise/interpolation/point_plan.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A noise at scattered points, interpolated from samples on a lattice by the weights that are best for its
// own covariance (AxisWeights). They are those of places between the samples, and linear from one place to
// the next. May be shared between threads.
class PointInterpolation {
 public:
  // As planned on the frame; the plan is not direct.
  PointInterpolation(const std::shared_ptr<const Noise<3>>& noise, const LatticeFrame<3>& frame,
                     const PointPlan& plan);

  // Overwrites `values`, one for each position.
  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const;

 private:
  Vec<3> steps_to(const Vec<3>& position) const { return (position - origin_) * per_step_; }
  void evaluate_some(std::span<const Vec<3>> positions, float* values) const;

  Vec<3> origin_;
  Vec<3> step_;  // of the samples, world units
  Vec<3> per_step_;
  PointWeights weights_;
  mutable CoarseStore<3> store_;
};

}  // namespace solidnoise
