#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <type_traits>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/noise_entry.h"

namespace solidnoise {

inline constexpr Choices<ImpulseWeights, 2> kImpulseWeightChoices{{
    {ImpulseWeights::signs, "signs"},
    {ImpulseWeights::uniform, "uniform"},
}};

inline constexpr Choices<ImpulseSpread, 2> kImpulseSpreadChoices{{
    {ImpulseSpread::strata, "strata"},
    {ImpulseSpread::poisson, "poisson"},
}};

// Those of noises that are sums over random impulses.
template <typename Options>
constexpr auto fields_of_impulses() {
  return list_fields(field("error", &Options::error, between(1e-4, 0.5), "relative RMS error",
                           "Accuracy that may be given up to save time"),
                     field("impulses", &Options::impulses, between(0.0, kImpulses.most),
                           "mean impulses per kernel; 0 chooses",
                           "How dense impulses are; by default as few as look Gaussian"),
                     field("impulses_process", &Options::impulses_process, kImpulseSpreadChoices,
                           "Impulses are spread evenly, so that fewer look Gaussian, or as in the papers"));
}

template <typename Options>
constexpr auto field_of_kurtosis() {
  return field("kurtosis", &Options::kurtosis, kKurtosis, "mean excess kurtosis",
               "How far from Gaussian strata may leave it, where impulses is 0")
      .without_flag();
}

template <typename Options>
constexpr auto fields_of_gradient() {
  return field("bounds_gradient", &Options::bounds_gradient,
               "Whether the gradient is as accurate, too; what is made of gradients has it so")
      .without_flag();
}

template <typename Options>
constexpr auto fields_of_filter() {
  return field("filter", &Options::filter, between(0.0, 1e9), "world units; 0 for none",
               "Standard deviation of a Gaussian that the noise is convolved with")
      .without_flag();
}

// What both kinds of Gabor noise have.
template <typename Options>
constexpr auto fields_of_band() {
  return list_fields(fields_of_frequency<Options>(),
                     field("bandwidth", &Options::bandwidth, between(0.05, 4.0), "octaves",
                           "Width of the band at half amplitude"),
                     fields_of_impulses<Options>(), field_of_kurtosis<Options>(),
                     fields_of_gradient<Options>(), part(&Options::evolution), fields_of_filter<Options>());
}

// Lengths in world units, frequencies in cycles per world unit, the density in impulses per world unit^Dim,
// the filter as the standard deviation of a Gaussian.
template <typename Noise>
void describe_impulses(const Noise& noise, const auto& of_noise) {
  of_noise("impulses_per_kernel", noise.impulses_per_kernel());
  of_noise("impulse_density", noise.impulse_density());
  of_noise("kurtosis_given_place", noise.kurtosis_given_place());
  of_noise("filter", noise.options().filter);
}

constexpr auto fields_of(std::type_identity<GaborNoiseOptions>) {
  using Options = GaborNoiseOptions;
  return list_fields(fields_of_band<Options>(),
                     field("weights", &Options::weights, kImpulseWeightChoices,
                           "Impulses weigh +1 or -1, or anything between"),
                     fields_of_place<Options>());
}

template <>
struct NoiseEntry<GaborNoiseOptions> {
  static constexpr std::string_view kName = "gabor";
  static constexpr std::string_view kTitle = "gabor noise";
  static constexpr std::string_view kHelp = "One band of frequencies, all directions alike";
  static constexpr int kLeastDimensions = 1;
  static constexpr int kMostDimensions = 4;
  template <int Dim>
  using Noise = GaborNoise<Dim>;

  template <int Dim>
  static void describe(const GaborNoiseOptions& options, const auto& of_kernel, const auto& of_noise) {
    const GaborNoise<Dim> noise(options);
    of_kernel("kind", "isotropic Gabor");
    of_kernel("frequency", noise.kernel().frequency());
    of_kernel("a", noise.kernel().a());
    of_kernel("radius", noise.radius());
    of_kernel("degree", noise.compact_kernel().degree());
    of_kernel("relative_error", noise.compact_kernel().relative_error());
    describe_impulses(noise, of_noise);
  }

  template <int Dim>
  static KernelSlice slice(const GaborNoiseOptions& options) {
    const GaborNoise<Dim> noise(options);
    return {noise.radius(),
            [kernel = noise.compact_kernel()](double x, double y) { return kernel.value(std::hypot(x, y)); }};
  }

  static std::string why_fixed(const GaborNoiseOptions& options);
};

constexpr auto fields_of(std::type_identity<OrientedGaborNoiseOptions>) {
  using Options = OrientedGaborNoiseOptions;
  return list_fields(fields_of_band<Options>(),
                     field("anisotropy", &Options::anisotropy, between(0.0, 1.0), "",
                           "0: all directions alike, 1: one direction"),
                     field("direction", &Options::direction, kDirections, "", "Where the waves travel"),
                     fields_of_place<Options>());
}

template <>
struct NoiseEntry<OrientedGaborNoiseOptions> {
  static constexpr std::string_view kName = "gabor-oriented";
  static constexpr std::string_view kTitle = "gabor-oriented noise";
  static constexpr std::string_view kHelp = "One band of frequencies, waves along a direction or along any";
  static constexpr int kLeastDimensions = 1;
  static constexpr int kMostDimensions = 4;
  template <int Dim>
  using Noise = OrientedGaborNoise<Dim>;

  template <int Dim>
  static void describe(const OrientedGaborNoiseOptions& options, const auto& of_kernel,
                       const auto& of_noise) {
    const OrientedGaborNoise<Dim> noise(options);
    of_kernel("kind", "oriented Gabor, random phase");
    of_kernel("frequency", noise.frequency());
    of_kernel("a", noise.kernel().a());
    of_kernel("radius", noise.radius());
    of_kernel("half_width", noise.envelope().radius());
    of_kernel("degree", noise.envelope().degree());
    of_kernel("relative_error", noise.options().error);
    describe_impulses(noise, of_noise);
  }

  // Of phase 0 and along the direction.
  template <int Dim>
  static KernelSlice slice(const OrientedGaborNoiseOptions& options) {
    const OrientedGaborNoise<Dim> noise(options);
    const Vec<Dim> wave = noise.kernel().frequency();
    return {noise.envelope().radius(), [envelope = noise.envelope(), wave](double x, double y) {
              return envelope.value(std::abs(x)) * envelope.value(std::abs(y)) *
                     std::cos(2.0 * std::numbers::pi * (wave.x * x + wave.y * y));
            }};
  }

  static std::string why_fixed(const OrientedGaborNoiseOptions& options);
};

constexpr auto fields_of(std::type_identity<SpectrumNoiseOptions>) {
  using Options = SpectrumNoiseOptions;
  return list_fields(
      field("exemplar", &Options::model, "What is taken over from an exemplar, as noisefit writes it"),
      field("channel", &Options::channel, at_least(0.0), "of the model", "Channel of the exemplar's model")
          .without_flag(),
      fields_of_frequency<Options>(), fields_of_impulses<Options>(), fields_of_gradient<Options>(),
      part(&Options::evolution), fields_of_filter<Options>(), fields_of_place<Options>());
}

// A noise by example, whose model is a file of its own.
template <>
struct NoiseEntry<SpectrumNoiseOptions> {
  static constexpr std::string_view kName = "spectrum";
  static constexpr std::string_view kTitle = "a noise by example";
  static constexpr std::string_view kHelp = "The spectrum of an exemplar, which noisefit measures";
  static constexpr int kLeastDimensions = 2;
  static constexpr int kMostDimensions = 3;
  template <int Dim>
  using Noise = SpectrumNoise<Dim>;

  template <int Dim>
  static void describe(const SpectrumNoiseOptions& options, const auto& of_kernel, const auto& of_noise) {
    const SpectrumNoise<std::clamp(Dim, kLeastDimensions, kMostDimensions)> noise(options);
    std::size_t components = 0;
    for (const SpectrumBand& band : noise.spectrum().bands) components += band.components.size();
    of_kernel("kind", "oriented Gabor by example, random phase");
    of_kernel("bands", noise.spectrum().bands.size());
    of_kernel("components", components);
    of_kernel("frequency", options.frequency);
    of_kernel("relative_error", options.error);
    of_noise("impulses_per_kernel", noise.impulses_per_kernel());
    of_noise("kurtosis_given_place", noise.kurtosis_given_place());
    of_noise("filter", options.filter);
  }

  // The covariance: all of its kernels at once.
  template <int>
  static KernelSlice slice(const SpectrumNoiseOptions& options) {
    const GaborSpectrum spectrum = options.filtered_spectrum();
    double widest = spectrum.bands.front().a;
    for (const SpectrumBand& band : spectrum.bands) widest = std::min(widest, band.a);
    return {1.0 / widest, [spectrum, variance = spectrum.variance()](double x, double y) {
              return spectrum.covariance({x, y, 0.0}) / variance;
            }};
  }
};

}  // namespace solidnoise
