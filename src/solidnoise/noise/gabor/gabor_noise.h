#pragma once

#include <cstdint>
#include <memory>

#include "solidnoise/noise/convolution/sparse_convolution.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/cube_averages.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Isotropic Gabor noise in Dim dimensions, 1 to 4: the sum of isotropic Gabor kernels at random impulses,
// each with a random weight (Lagae et al. 2011, eq. 15), scaled to unit variance by the closed form.
//
// Differences from the paper: impulses are in strata (Strata), which leaves the spectrum as it is and takes
// the excess kurtosis away; by default there are the fewest for which its mean is 0 (where that takes many,
// 0.02, StrataChoice), and within 1/4 given the place (options().impulses_process has Poisson's too); the
// kernel is made compact by a least-squares fit (CompactKernel) in place of being cut off, so that value and
// gradient have no seam, and its variance and spectrum are those of what is evaluated, exactly; the hash does
// not repeat. Impulses do not depend on options().error. The variance is 1 for every number of impulses; with
// few of them the values are not Gaussian, and excess_kurtosis() says by how much.
//
// With options().filter it is that noise convolved with a Gaussian (gaussian_filter.h): the same impulses
// with the filtered kernel, off by at most options().error of the unfiltered standard deviation, and 0 where
// less than that is left. The variance is then what the filter leaves.
//
// Cost: proportional to impulses_per_kernel() and to the kernel's degree; independent of its radius in
// samples, once that is a few samples.
template <int Dim>
class GaborNoise final : public Noise<Dim> {
 public:
  // Throws std::invalid_argument: options.validate(), a period below two kernel radii, or too many impulses.
  explicit GaborNoise(const GaborNoiseOptions& options);

  const GaborNoiseOptions& options() const { return options_; }
  // The kernel, filtered if options().filter says so, and as it is evaluated: made compact. Of a noise of
  // which the filter leaves nothing, the unfiltered ones.
  const IsotropicGaborKernel<Dim>& kernel() const { return kernel_; }
  const CompactKernel& compact_kernel() const { return compact_; }
  double radius() const { return compact_.radius(); }             // world units
  double impulses_per_kernel() const { return impulses_; }        // N, mean
  double impulse_density() const { return density_; }             // per world unit^Dim
  double amplitude() const { return convolution_->amplitude(); }  // of the compact kernel in the noise

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return convolution_->block(box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    convolution_->evaluate(points, samples);
  }
  double variance() const override { return variance_; }
  Vec<Dim> gradient_variance() const override;
  double power_spectrum(const Vec<Dim>& frequency) const override;
  double excess_kurtosis() const override;
  // How far from that it is, at most, at a given place in the planes of strata; 0 for a Poisson process.
  double kurtosis_given_place() const;
  typename Noise<Dim>::Band band() const override;
  WaveMixture<Dim> waves() const override;
  double covariance(const Vec<Dim>& displacement) const override;

  // The impulses that the noise sums, and the weight of one at the noise's time: for whoever sums them in
  // another way.
  const ImpulseProcess<Dim>& impulses() const { return convolution_->process(); }
  float weight(std::uint64_t mark) const;

 private:
  bool filter_kernel();
  RadialAverages averages() const;

  GaborNoiseOptions options_;
  IsotropicGaborKernel<Dim> kernel_;
  CompactKernel compact_;
  double impulses_ = 0.0;
  double density_ = 0.0;
  double unfiltered_energy_ = 0.0;  // of the compact kernel
  double variance_ = 0.0;
  Cubes cubes_;  // of strata; of side 0 if there are none
  std::shared_ptr<const SparseConvolution<Dim>> convolution_;
};

extern template class GaborNoise<1>;
extern template class GaborNoise<2>;
extern template class GaborNoise<3>;
extern template class GaborNoise<4>;

}  // namespace solidnoise
