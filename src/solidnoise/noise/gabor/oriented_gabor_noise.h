#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/sparse_convolution.h"
#include "solidnoise/noise/gabor/directions.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/cube_averages.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// The wave that an impulse of an oriented kernel carries.
template <int Dim>
struct ImpulseWave {
  Vec<Dim> frequency{0.0};  // cycles per world unit
  double phase = 0.0;       // cycles, in [0, 1)
  double weight = 1.0;
};

// Oriented kernels with waves of their own for sparse convolution. `Draw` makes the ImpulseWave<Dim> of an
// impulse from its mark: the wave is drawn(mark). Weights count where the sum is weighted, in 3 dimensions at
// most.
template <int Dim, typename Draw>
class WaveKernel final : public ImpulseKernel {
 public:
  WaveKernel(OrientedSum sum, Draw draw, const std::array<CellAxis, Dim>& axes)
      : sum_(std::move(sum)), draw_(std::move(draw)), axes_(axes) {}

  CullBox::Support support() const override { return CullBox::Support::box; }
  int attribute_count() const override {
    if (sum_.weighted) return 1 + OrientedSum::kWeight;
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
      if (sum_.weighted) attributes[OrientedSum::kWeight][i] = static_cast<float>(wave.weight);
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

// What cubes make of its mean square.
inline ProductAverages wave_averages(const CompactKernel& envelope, int dimensions) {
  return {dimensions, [envelope](double d) { return std::pow(envelope.value(d), 2); }, envelope.radius(),
          0.5};
}

// Gabor noise of oriented kernels with random phase in Dim dimensions, 1 to 4: the sum of
//   envelope(d) cos(2 pi w.d + phase)
// at random impulses, each with a random phase and a wave vector w of length F0 whose
// direction is drawn from a cone, from the whole sphere (isotropic noise) to a single axis. Scaled to unit
// variance by the closed form. (Galerne et al. 2012, eq. 1; isotropic as in Lagae et al. 2011, eq. 5.)
//
// Differences from the papers: impulses are in strata, as those of GaborNoise; the Gaussian envelope exp(-pi
// a^2 d^2) is a product of one compact factor per axis (compact_envelope), so that value and gradient have no
// seam and a lattice costs two multiply-adds per sample and impulse; its support is a cube in place of a
// ball. `radius()` is that of the ball whose truncation would give the same error, so that
// impulses_per_kernel() means what it means in the papers. It needs far fewer impulses than the isotropic
// kernel for the same excess kurtosis.
//
// With options().filter it is that noise convolved with a Gaussian, as GaborNoise is, for any anisotropy.
template <int Dim>
class OrientedGaborNoise final : public Noise<Dim> {
 public:
  // Throws std::invalid_argument: options.validate(), a period below two half-widths of the support, or a
  // direction without a component in the first Dim axes.
  // `phase_shift` in cycles is added to the phase of every impulse: another one gives another part of the
  // same phasor, 0 the noise of the options.
  explicit OrientedGaborNoise(const OrientedGaborNoiseOptions& options, double phase_shift = 0.0);

  const OrientedGaborNoiseOptions& options() const { return options_; }
  // The kernel along the cone's axis, of unit amplitude, or filtered if options().filter says so; and the
  // envelope of one axis as it is evaluated, of unit peak. Of a noise of which the filter leaves nothing, the
  // unfiltered ones.
  const RandomPhaseGaborKernel<Dim>& kernel() const { return kernel_; }
  const CompactKernel& envelope() const { return envelope_; }
  double frequency() const { return frequency_; }  // of the kernel, cycles per world unit
  const DirectionCone<Dim>& directions() const { return directions_; }
  double radius() const { return radius_; }                       // world units
  double impulses_per_kernel() const { return impulses_; }        // N, mean
  double impulse_density() const { return density_; }             // per world unit^Dim
  double amplitude() const { return convolution_->amplitude(); }  // of the envelope in the noise

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return convolution_->block(box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    convolution_->evaluate(points, samples);
  }
  double variance() const override { return variance_; }
  Vec<Dim> gradient_variance() const override;
  // Where directions vary, that of the kernel before it was made compact; the two differ by less than
  // options().error of the total.
  double power_spectrum(const Vec<Dim>& frequency) const override;
  double excess_kurtosis() const override { return excess_kurtosis_; }
  // How far from that it is, at most, at a given place in the planes of strata; 0 for a Poisson process.
  double kurtosis_given_place() const { return kurtosis_given_place_; }
  typename Noise<Dim>::Band band() const override;
  WaveMixture<Dim> waves() const override;

  // The impulses that the noise sums, and what an impulse carries: for whoever sums them in another way.
  const ImpulseProcess<Dim>& impulses() const { return convolution_->process(); }
  ImpulseWave<Dim> wave(std::uint64_t mark) const;  // at the noise's time

 private:
  bool filter_kernel();

  OrientedGaborNoiseOptions options_;
  double phase_shift_;
  DirectionCone<Dim> directions_;
  RandomPhaseGaborKernel<Dim> kernel_;
  double frequency_;  // of the kernel
  CompactKernel envelope_;
  double radius_ = 0.0;
  double impulses_ = 0.0;
  double density_ = 0.0;
  double variance_ = 0.0;
  double excess_kurtosis_ = 0.0;
  double kurtosis_given_place_ = 0.0;
  std::shared_ptr<const SparseConvolution<Dim>> convolution_;
};

extern template class OrientedGaborNoise<1>;
extern template class OrientedGaborNoise<2>;
extern template class OrientedGaborNoise<3>;
extern template class OrientedGaborNoise<4>;

}  // namespace solidnoise
