#pragma once

#include <type_traits>

#include "solidnoise/core/fields.h"
#include "solidnoise/noise/fractal_noise.h"

namespace solidnoise {

// What the tables of all noises have: octaves, recipes and flags rely on these fields.
template <typename Options>
constexpr auto fields_of_frequency() {
  return field("frequency", &Options::frequency, kPositive, "cycles per world unit", "Principal frequency");
}

template <typename Options>
constexpr auto fields_of_place() {
  return list_fields(field("seed", &Options::seed, "Another seed makes another noise"),
                     field("period", &Options::period, at_least(0.0), "world units; 0 for none",
                           "Length along each axis after which the noise repeats"));
}

constexpr auto fields_of(std::type_identity<FractalOptions>) {
  using Options = FractalOptions;
  return list_fields(
      field("octaves", &Options::octaves, between(1, 16), "", "Octaves that are summed"),
      field("lacunarity", &Options::lacunarity, between(1.0 + 1e-9, 64.0), "frequency ratio of octaves",
            "Frequency of an octave over that of the one before it"),
      field("gain", &Options::gain, kPositive, "amplitude ratio of octaves",
            "Amplitude of an octave over that of the one before it"),
      field("renormalize", &Options::renormalize, "Keep the variance at 1, whatever the octaves"));
}

}  // namespace solidnoise
