#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/gabor/directions.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/impulse_strata.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// What the noises of a spectrum share: how impulses are shared out between its bands, and how an impulse gets
// its frequency (Galerne et al. 2012, section 4.2).

// A band as far as its impulses go. Its kernels are of unit amplitude.
struct BandShare {
  double variance = 0.0;
  double support = 1.0;  // the volume in which impulses are counted
  StrataChoice choice;   // of the kernels of unlimited support
};

// With kernels of one amplitude A in all bands the density of a band is variance / (A^2 M), M the kernel's
// second moment: the number of impulses goes with 1 / A^2, the excess kurtosis with A^2. Weak bands would
// then have less than one impulse within reach, whose kernels, as strong as all others, are seen one by one:
// they get one in each balanced cube (of a Poisson process, kLeastImpulses in the support), of a smaller
// amplitude. (The paper has one amplitude for all bands.)
struct ImpulseBudget {
  std::vector<double> densities;  // of the bands, impulses per world unit^Dim
  double impulses = 0.0;          // in the supports of all bands together, N
};

inline constexpr double kLeastImpulses = 4.0;  // in a band's support

// Where the eye takes a noise by example for Gaussian: well below kDefaultKurtosis and kPlaceKurtosis, for
// its kernels reach over many waves, each of one frequency of the spectrum, and while their histogram is
// Gaussian, a few of them are still seen as gratings that cross. Of a Poisson process that is an excess
// kurtosis; strata have none, but given the place. (Found by eye on photographs of moss and soil; the paper
// takes 1024 impulses, a Poisson process of ours some 500 in two dimensions and 1000 in three, strata whose
// frequencies are in strata, too, some 110.)
inline constexpr double kExampleKurtosis = 1.0 / 64.0;
inline constexpr double kExamplePlaceKurtosis = 1.0 / 70.0;

// For N impulses, or for N = 0 the fewest of an excess kurtosis, given the place, as above; weak bands may
// make it more. The bands' variances add up to 1.
ImpulseBudget share_impulses(std::span<const BandShare> bands, double impulses, ImpulseSpread spread);

// How far the excess kurtosis at a place in the planes of cubes may be from its mean, a bound, of bands with
// strata of these densities.
double kurtosis_given_place(std::span<const BandShare> bands, std::span<const double> densities);

double variance_of(const SpectrumBand& band);
// Root mean square of the components' frequencies, by variance; cycles per world unit.
double rms_frequency(const SpectrumBand& band);

// The spectrum scaled to a variance of 1, without bands that have none.
GaborSpectrum of_unit_variance(const GaborSpectrum& spectrum);

// The frequencies between which all but a thousandth of the variance lies: those of the components, and 3.5
// standard deviations a / sqrt(4 pi) more on either side.
Noise<2>::Band frequency_interval(const GaborSpectrum& spectrum);

// Streams of random numbers that the bands derive from a noise's seed: one each.
inline constexpr std::uint64_t kBandStream = 3000;

// Draws frequencies of a band's impulses, in proportion to the components' variances: shares apart (share_of)
// are directions apart, or wavelengths where the spectrum is isotropic. Cheap to copy.
template <int Dim>
class ComponentDraw {
 public:
  ComponentDraw(const SpectrumBand& band, bool isotropic);

  Vec<Dim> operator()(double share, RandomStream& stream) const;

 private:
  std::shared_ptr<const CumulativeTable> components_;
  std::shared_ptr<const std::vector<Vec<Dim>>> frequencies_;
  std::optional<DirectionCone<Dim>> directions_;
};

}  // namespace solidnoise
