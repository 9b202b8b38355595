#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "solidnoise/noise/interpolation/axis_weights.h"
#include "solidnoise/noise/interpolation/coarse_samples.h"
#include "solidnoise/noise/interpolation/interpolate_axis.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A noise on one lattice, with the weights that its samples are interpolated by. May be shared between
// threads.
template <int Dim>
class LatticeInterpolation {
 public:
  LatticeInterpolation(const std::shared_ptr<const Noise<Dim>>& noise, const LatticeFrame<Dim>& frame,
                       const LatticeWeights& weights);

  const LatticeFrame<Dim>& frame() const { return frame_; }
  CoarseStore<Dim>& store() const { return store_; }

  // The coarse samples that samples from `begin` to `end` need; of ranges without end, as many as can be
  // counted.
  SampleRange<Dim> coarse_range(const Index<Dim>& begin, const Index<Dim>& end) const;

  // What makes `count` samples along an axis, from `begin` on; the same for all that begin at one phase.
  std::int64_t phase(int axis, std::int64_t begin) const;
  AxisTaps taps(int axis, AxisWeights::Of of, std::int64_t begin, int count) const;

 private:
  struct Axis {
    AxisStep shape;
    std::array<std::vector<float>, 2> weights;  // of values and slopes, phase by phase
  };

  const Axis& axis_of(int axis) const { return axes_[static_cast<std::size_t>(axis)]; }

  LatticeFrame<Dim> frame_;
  std::vector<Axis> axes_;
  mutable CoarseStore<Dim> store_;
};

// Interpolates the samples of lattices in one box. Belongs to one thread.
template <int Dim>
class LatticeInterpolator {
 public:
  // The interpolation must outlive this.
  LatticeInterpolator(const LatticeInterpolation<Dim>& interpolation, const Box<Dim>& box);

  void values(const Lattice<Dim>& lattice, std::span<float> values);
  void gradient(const Lattice<Dim>& lattice, const std::array<std::span<float>, Dim>& gradient);

 private:
  // Samples that are interpolated along some axes: as values, and as slopes of one of these axes.
  using Arrays = std::array<std::vector<float>, 1 + Dim>;

  struct KnownTaps {
    std::int64_t phase;
    int count;
    std::unique_ptr<AxisTaps> taps;
  };

  void interpolate(const Lattice<Dim>& lattice, Quantity quantity, const std::array<float*, 1 + Dim>& out);
  const AxisTaps& taps_of(int axis, AxisWeights::Of of, const Lattice<Dim>& lattice);

  const LatticeInterpolation<Dim>& interpolation_;
  CoarseSamples<Dim> coarse_;
  std::array<std::array<std::vector<KnownTaps>, 2>, Dim> taps_;
  Arrays from_;
  Arrays to_;
};

}  // namespace solidnoise
