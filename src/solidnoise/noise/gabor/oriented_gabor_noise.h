#pragma once

#include <memory>

#include "solidnoise/noise/convolution/sparse_convolution.h"
#include "solidnoise/noise/gabor/directions.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/gabor/wave_kernel.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/gabor_kernel.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Gabor noise of oriented kernels with random phase in Dim dimensions, 1 to 4: the sum of
//   envelope(d) cos(2 pi w.d + phase)
// at the impulses of a Poisson process, each with a random phase and a wave vector w of length F0 whose
// direction is drawn from a cone, from the whole sphere (isotropic noise) to a single axis. Scaled to unit
// variance by the closed form. (Galerne et al. 2012, eq. 1; isotropic as in Lagae et al. 2011, eq. 5.)
//
// Differences from the papers: the Gaussian envelope exp(-pi a^2 d^2) is a product of one compact factor per
// axis (compact_envelope), so that value and gradient have no seam and a lattice costs two multiply-adds per
// sample and impulse; its support is a cube in place of a ball. `radius()` is that of the ball whose
// truncation would give the same error, so that impulses_per_kernel() means what it means in the papers. It
// needs far fewer impulses than the isotropic kernel for the same excess kurtosis.
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
  std::shared_ptr<const SparseConvolution<Dim>> convolution_;
};

extern template class OrientedGaborNoise<1>;
extern template class OrientedGaborNoise<2>;
extern template class OrientedGaborNoise<3>;
extern template class OrientedGaborNoise<4>;

}  // namespace solidnoise
