#pragma once

#include <type_traits>

#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/noise_fields.h"

namespace solidnoise {

inline constexpr Choices<ImpulseWeights, 2> kImpulseWeightChoices{{
    {ImpulseWeights::signs, "signs"},
    {ImpulseWeights::uniform, "uniform"},
}};

template <typename Options>
constexpr auto fields_of_impulses() {
  return list_fields(field("error", &Options::error, between(1e-4, 0.5), "relative RMS error",
                           "What may be given up to save time"),
                     field("impulses", &Options::impulses, between(0.0, 100000.0),
                           "mean impulses per kernel; 0 chooses", "As few as look Gaussian, or so many"));
}

// What both kinds of Gabor noise have.
template <typename Options>
constexpr auto fields_of_band() {
  return list_fields(fields_of_frequency<Options>(),
                     field("bandwidth", &Options::bandwidth, between(0.05, 4.0), "octaves",
                           "Width of the band at half amplitude"),
                     fields_of_impulses<Options>(), part(&Options::evolution),
                     field("filter", &Options::filter, at_least(0.0), "world units; 0 for none",
                           "Standard deviation of a Gaussian that the noise is convolved with")
                         .without_flag());
}

constexpr auto fields_of(std::type_identity<GaborNoiseOptions>) {
  using Options = GaborNoiseOptions;
  return list_fields(fields_of_band<Options>(),
                     field("weights", &Options::weights, kImpulseWeightChoices,
                           "Impulses weigh +1 or -1, or anything between"),
                     fields_of_place<Options>());
}

constexpr auto fields_of(std::type_identity<OrientedGaborNoiseOptions>) {
  using Options = OrientedGaborNoiseOptions;
  return list_fields(fields_of_band<Options>(),
                     field("anisotropy", &Options::anisotropy, between(0.0, 1.0), "",
                           "0: all directions alike, 1: one direction"),
                     field("direction", &Options::direction, kFinite, "", "Where the waves travel"),
                     fields_of_place<Options>());
}

constexpr auto fields_of(std::type_identity<SpectrumNoiseOptions>) {
  using Options = SpectrumNoiseOptions;
  return list_fields(
      field("exemplar", &Options::model, "What is taken over from an exemplar, as noisefit writes it")
          .without_flag(),
      field("channel", &Options::channel, at_least(0.0), "of the model", "Channel of the exemplar's model")
          .without_flag(),
      fields_of_frequency<Options>(), fields_of_impulses<Options>(), part(&Options::evolution),
      fields_of_place<Options>());
}

}  // namespace solidnoise
