#pragma once

#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/noise/interpolation/axis_weights.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// How far points lie from the lattice's samples that they come from.
struct PointSpread {
  Vec<3> reach{0.0};    // to either side, world units: most are no farther
  double volume = 1.0;  // of what the points fill, over that of the lattice
};

// How one part of a noise is evaluated at scattered points.
struct PointPlan {
  double spacing = 0.0;  // of samples that points are interpolated from, in steps of the frame; 0: none are
  int taps = 0;          // along each axis
  double squared_error = 0.0;  // the part's amplitude included
  double nanoseconds = 0.0;    // of a point; see noise_cost.h

  bool direct() const { return spacing == 0.0; }
};

// Chooses for each part of a noise, or for the noise itself where it has no parts, how it is quickest at
// points that lie among the samples of a lattice, about as dense as they are: summed there, or interpolated
// from a lattice of its own, in so many steps of the frame, from 4, 6 or 8 samples along each axis. Together
// the parts' mean square errors stay within the budget that InterpolationPlanner has for the lattice itself;
// they are in closed form, and means over all places between samples (predict_error()).
//
// Points that spread so far that those of a block of 32 steps would need too many samples are summed.
//
// Samples lie at whole multiples of their spacing from the frame's origin, which divides its periods. What is
// not stationary is summed.
std::vector<PointPlan> plan_points(const Noise<3>& noise, const LatticeFrame<3>& frame, double error,
                                   const PointSpread& spread = {});

// The weights along each axis, of so many places between two samples that are `step` apart (world units).
LatticeWeights point_weights(const WaveMixture<3>& waves, const Vec<3>& step, int places, int taps);

}  // namespace solidnoise
