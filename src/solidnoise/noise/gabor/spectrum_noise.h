#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/noise/gabor/spectrum_bands.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Parameters of a noise by example.
struct SpectrumNoiseOptions {
  ExemplarModel model{};
  int channel = 0;         // of the model, from 0
  double frequency = 8.0;  // where the model's principal_frequency() comes to lie, cycles per world unit; > 0
  double error = 0.02;     // relative RMS error against kernels of infinite support; 1e-4 to 0.5
  bool bounds_gradient = false;  // whether the gradient's error is within `error`, too, relative to itself
  double impulses = 0.0;  // mean impulses under the kernels of all bands, N; 0: the fewest that look Gaussian
  ImpulseSpread impulses_process = ImpulseSpread::strata;
  std::uint64_t seed = 0;
  Vec<4> period{0.0};     // world units per axis; 0: none; else at least 2 radii of the largest kernel
  Evolution evolution{};  // how it changes with time; by default it does not
  double filter = 0.0;    // standard deviation of a Gaussian that it is convolved with, world units; 0: none

  // The channel's spectrum, unfiltered, frequencies in cycles per world unit. Precondition: valid options.
  GaborSpectrum spectrum() const;
  // What the filter leaves of it; if that is nothing, all of it.
  GaborSpectrum filtered_spectrum() const;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const SpectrumNoiseOptions&, const SpectrumNoiseOptions&) = default;
};

// Bandwidth-quantized Gabor noise in Dim dimensions, 2 or 3: the noise whose power spectrum is a sparse sum
// of Gaussians (Galerne et al. 2012, sections 3 and 4), scaled to unit variance. Each band is a sum of
// oriented kernels of one envelope at random impulses of its own, with random phases and
// with frequencies drawn from the band's components in proportion to their variances (section 4.2).
//
// Impulses are shared out between the bands by variance, N_b = (variance_b / variance) N, so that every
// kernel has the same amplitude, but for weak bands, see ImpulseBudget. Unlike the paper, impulses
// are in strata (GaborNoise), the Gaussians are compact (as in OrientedGaborNoise), and cells are hashed
// without a period.
//
// With options.filter it is that noise convolved with a Gaussian, as GaborNoise is: the same impulses, each
// with the weight that the filter leaves of its frequency (GaborSpectrum::filtered), bands being off by at
// most options.error of the standard deviation that they had, and left out where less than that is left of
// them.
template <int Dim>
class SpectrumNoise final : public Noise<Dim> {
 public:
  // Throws std::invalid_argument: options.validate(), a spectrum of other dimensions, or a period below two
  // half-widths of the largest kernel.
  explicit SpectrumNoise(const SpectrumNoiseOptions& options);

  // Of unit variance, or what the filter leaves of that; cycles per world unit.
  const GaborSpectrum& spectrum() const { return spectrum_; }
  double impulses_per_kernel() const { return impulses_; }  // N, mean
  // Of the band that has the fewest, per world unit^Dim.
  double least_impulse_density() const { return least_density_; }
  // How far the excess kurtosis at a place in the planes of strata may be from its mean, without a filter and
  // a period; 0 of a Poisson process.
  double kurtosis_given_place() const { return solidnoise::kurtosis_given_place(shares_, densities_); }

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override { return bands_->block(box); }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    bands_->evaluate(points, samples);
  }
  double variance() const override { return bands_->variance(); }
  Vec<Dim> gradient_variance() const override { return bands_->gradient_variance(); }
  // Of the kernels before they were made compact; the two differ by less than options.error of the total.
  double power_spectrum(const Vec<Dim>& frequency) const override;
  double excess_kurtosis() const override { return bands_->excess_kurtosis(); }
  typename Noise<Dim>::Band band() const override { return bands_->band(); }
  std::vector<typename Noise<Dim>::Part> parts() const override { return bands_->parts(); }

 private:
  GaborSpectrum spectrum_;
  double impulses_ = 0.0;
  double least_density_ = 0.0;
  std::vector<BandShare> shares_;
  std::vector<double> densities_;  // of the bands' strata
  std::unique_ptr<const FractalNoise<Dim>> bands_;
};

extern template class SpectrumNoise<2>;
extern template class SpectrumNoise<3>;

}  // namespace solidnoise
