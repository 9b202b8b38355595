#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/convolution/impulse_statistics.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/sparse_convolution.h"
#include "solidnoise/noise/kernel/compact_kernel.h"

namespace solidnoise {

// The wave that an impulse of an oriented kernel carries.
template <int Dim>
struct ImpulseWave {
  Vec<Dim> frequency{0.0};  // cycles per world unit
  double phase = 0.0;       // cycles, in [0, 1)
};

// Oriented kernels with waves of their own for sparse convolution. `Draw` makes the ImpulseWave<Dim> of an
// impulse from its mark: the wave is drawn(mark).
template <int Dim, typename Draw>
class WaveKernel final : public ImpulseKernel {
 public:
  WaveKernel(OrientedSum sum, Draw draw, const std::array<CellAxis, Dim>& axes)
      : sum_(std::move(sum)), draw_(std::move(draw)), axes_(axes) {}

  CullBox::Support support() const override { return CullBox::Support::box; }
  int attribute_count() const override {
    return 1 + (Dim == 4 ? OrientedSum::wave(kT) : OrientedSum::kPhase);
  }

  void draw(std::span<const std::uint64_t> marks, ImpulseAttributes& attributes) const override {
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const ImpulseWave<Dim> wave = draw_(marks[i]);
      for (int axis = 0; axis < Dim; ++axis) {
        attributes[OrientedSum::wave(role_of_axis<Dim>(axis))][i] =
            static_cast<float>(wave.frequency[axis] * axes_[axis].size());
      }
      attributes[OrientedSum::kPhase][i] = static_cast<float>(wave.phase);
    }
  }

  void sum(const ImpulseList& list, const SampleBrick& brick, Derivatives derivatives,
           BrickSums& sums) const override {
    sum_oriented(sum_, list, brick, derivatives, sums);
  }
  void sum(const ImpulseList& list, const SampleCluster& cluster, Derivatives derivatives,
           ClusterSums& sums) const override {
    sum_oriented(sum_, list, cluster, derivatives, sums);
  }

 private:
  OrientedSum sum_;
  Draw draw_;
  std::array<CellAxis, Dim> axes_;
};

// Moments of the product of the axes' envelopes times a wave, means over its phase: cos^2 is 1/2 and cos^4 is
// 3/8.
inline KernelMoments wave_moments(const CompactKernel& envelope, int dimensions) {
  return {0.5 * std::pow(envelope.energy(), dimensions),
          0.375 * std::pow(envelope.fourth_moment(), dimensions)};
}

}  // namespace solidnoise
