#pragma once

#include <vector>

#include "solidnoise/core/cost.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/noise/interpolation/point_plan.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// What a thread takes to evaluate a noise at so many samples of a lattice, in blocks of `side` along an axis,
// as InterpolationPlanner plans it: impulses that reach a sample, and the impulses of a block, which lie in
// it and within a radius of it, but for the bytes of samples that others are interpolated from. Without
// impulses (gradient noise) a sample takes the same time everywhere.
struct LatticeWork {
  double samples = 0.0;
  double side = 64.0;  // samples
};
Cost cost_on_lattice(const Noise<3>& noise, const LatticeFrame<3>& frame, const LatticeWork& work,
                     const std::vector<InterpolationPlan<3>>& plans);

// The impulses of noise with these waves that are held at a time to evaluate cubes of `side` samples along
// each axis, `step` apart in world units: those that reach a cube; or a brick of it, where they are more than
// kMostImpulsesInBlock.
struct ImpulsesHeld {
  double count = 0.0;
  double side = 0.0;  // of what they reach, samples
  double bytes = 0.0;
};
ImpulsesHeld impulses_held(const WaveMixture<3>& waves, const Vec<3>& step, double side);

// The same at points that fill a line, a plane or space evenly; and as plan_points() plans it.
struct PointWork {
  double points = 0.0;
  double spacing = 0.0;  // of neighbours, world units; far apart, each makes impulses of its own
  int axes = 3;          // of what they fill
};
template <int Dim>
Cost cost_at_points(const Noise<Dim>& noise, const PointWork& work);
Cost cost_at_points(const Noise<3>& noise, double points, const std::vector<PointPlan>& plans);

}  // namespace solidnoise
