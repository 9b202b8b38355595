#pragma once

#include <memory>

#include "solidnoise/noise/interpolation/lattice_interpolation.h"
#include "solidnoise/noise/interpolation/point_plan.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The noise as it is quickest on one lattice: a band-limited field is known from few samples. On blocks of
// that lattice, each of the noise's parts is evaluated at every m-th sample of an axis and interpolated from
// these by the weights that are best for its own covariance (AxisWeights), as InterpolationPlanner chooses
// within a root mean square error of `error` times the standard deviation; the gradient from values at every
// so many samples of its own, within `error` times the root mean square of its length. On other lattices and
// at scattered points it is the noise itself.
//
// Coarse samples are those whose index is a multiple of m, counted from the frame's origin, so that a
// sample's value does not depend on the block or lattice that it is asked for in. They are evaluated once, in
// bricks, as far as samples that are asked for need them, and shared by all blocks: the noise keeps those
// used last, up to 64 MB for each part. It may nevertheless be shared between threads.
//
// Values do not depend on whether the gradient is asked for with them. Where it is the gradient that is
// wanted (`quantity`) and that is quickest summed, its sum gives the values, too.
//
// Statistics are those of the noise. Returns the noise itself where nothing is to be gained.
template <int Dim>
std::shared_ptr<const Noise<Dim>> interpolate(std::shared_ptr<const Noise<Dim>> noise,
                                              const LatticeFrame<Dim>& frame, double error,
                                              Quantity quantity = Quantity::values);

// The noise as it is quickest at points that lie about as dense as the samples of a lattice, but not on it,
// such as voxels' positions that a warp moves: its parts' values are interpolated there from samples of
// coarser or finer lattices, which are kept as above, within the same error (plan_points()). The frame
// and the spread decide how, not the points: a value depends on its position only. Gradients, and lattices,
// are the noise's own.
std::shared_ptr<const Noise<3>> interpolate_at_points(std::shared_ptr<const Noise<3>> noise,
                                                      const LatticeFrame<3>& frame, double error,
                                                      const PointSpread& spread = {});

}  // namespace solidnoise
