#pragma once

#include <concepts>
#include <functional>

#include "solidnoise/core/fields.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// What all else needs to know of one kind of noise, beside the table of its fields: it is made, filtered,
// varied, described, pictured, and read from recipes and flags by its entry. There is a specialisation for
// the options of each kind, in the noise's own files; noise_entries.h has them all.
//
//   template <>
//   struct NoiseEntry<GaborNoiseOptions> {
//     static constexpr std::string_view kName = "gabor";         // in recipes and flags
//     static constexpr std::string_view kTitle = "gabor noise";  // in messages
//     static constexpr std::string_view kHelp = "...";           // one line: what it is
//     static constexpr int kLeastDimensions = 1;
//     static constexpr int kMostDimensions = 4;
//     template <int Dim>
//     using Noise = GaborNoise<Dim>;  // made of the options
//
//     // What --describe prints: calls kernel(key, value) and noise(key, value), of a kernel and of the
//     whole. template <int Dim> static void describe(const GaborNoiseOptions& options, const auto& kernel,
//     const auto& noise); template <int Dim> static KernelSlice slice(const GaborNoiseOptions& options);
//
//     // Of a noise whose kernel may vary from place to place: why these options may not; empty if they may.
//     static std::string why_fixed(const GaborNoiseOptions& options);
//   };
//
// The options have `frequency`, `seed` and `period`, which octaves rely on, and validate(); with a field
// `error` they share it with interpolation (ErrorBudget), with a `filter` the noise can be convolved with a
// Gaussian, with an `evolution` it can change with time, with a `model` it is by example.
template <typename Options>
struct NoiseEntry;

// A kernel on the plane of x and y through its middle, world units: 0 beyond +-half_width.
struct KernelSlice {
  double half_width = 0.0;
  std::function<double(double x, double y)> value;
};

template <typename Options>
concept CanFilter = requires(Options options) {
  options.filter;
};
template <typename Options>
concept CanEvolve = requires(Options options) {
  options.evolution;
};
template <typename Options>
concept IsByExample = requires(Options options) {
  options.model;
};
template <typename Options>
concept CanVary = requires(Options options) {
  NoiseEntry<Options>::why_fixed(options);
};
// Phase and intensity are those of the noise and of another one, a quarter of a wave behind.
template <typename Options>
concept HasPhase = std::constructible_from<typename NoiseEntry<Options>::template Noise<3>, Options, double>;

// Fields that all noises have.
template <typename Options>
constexpr auto fields_of_frequency() {
  return field("frequency", &Options::frequency, kFrequencies, "cycles per world unit",
               "Principal frequency");
}

template <typename Options>
constexpr auto fields_of_place() {
  return list_fields(field("seed", &Options::seed, "Another seed makes another noise"),
                     field("period", &Options::period, at_least(0.0), "world units; 0 for none",
                           "Length along each axis after which the noise repeats"));
}

}  // namespace solidnoise
