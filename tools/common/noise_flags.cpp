#include "common/noise_flags.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/parse_value.h"
#include "common/recipe_file.h"
#include "common/text_file.h"
#include "common/usage_error.h"
#include "solidnoise/core/check.h"
#include "solidnoise/noise/cheapest_generator.h"
#include "solidnoise/noise/gabor/gabor_fields.h"
#include "solidnoise/noise/gradient/gradient_fields.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise {
namespace {

using Gabor = GaborNoiseOptions;
using Oriented = OrientedGaborNoiseOptions;
using Kensler = GradientNoiseOptions;
using Spectrum = SpectrumNoiseOptions;

constexpr std::array<std::string_view, 3> kNoiseTypes{"gabor", "gabor-oriented", "kensler"};

// Where each kind of noise keeps a field; null for those that have none.
template <typename Value>
struct Field {
  Value Gabor::*gabor;
  Value Oriented::*oriented;
  Value Kensler::*kensler;
  Value Spectrum::*spectrum;
};

constexpr Field<double> kFrequency{&Gabor::frequency, &Oriented::frequency, &Kensler::frequency,
                                   &Spectrum::frequency};
constexpr Field<double> kBandwidth{&Gabor::bandwidth, &Oriented::bandwidth, nullptr, nullptr};
constexpr Field<double> kError{&Gabor::error, &Oriented::error, nullptr, &Spectrum::error};
constexpr Field<double> kImpulses{&Gabor::impulses, &Oriented::impulses, nullptr, &Spectrum::impulses};
constexpr Field<double> kAnisotropy{nullptr, &Oriented::anisotropy, nullptr, nullptr};
constexpr Field<Vec<4>> kDirection{nullptr, &Oriented::direction, nullptr, nullptr};
constexpr Field<Vec<4>> kPeriod{&Gabor::period, &Oriented::period, &Kensler::period, &Spectrum::period};
constexpr Field<std::uint64_t> kSeed{&Gabor::seed, &Oriented::seed, &Kensler::seed, &Spectrum::seed};
constexpr Field<ImpulseWeights> kWeights{&Gabor::weights, nullptr, nullptr, nullptr};
constexpr Field<Kensler::Kernel> kKernel{nullptr, nullptr, &Kensler::kernel, nullptr};
constexpr Field<Kensler::Support> kSupport{nullptr, nullptr, &Kensler::support, nullptr};
constexpr Field<Kensler::Hash> kHash{nullptr, nullptr, &Kensler::hash, nullptr};

template <typename Options, typename Value>
Value* find(Options* options, Value Options::*member) {
  return options && member ? &(options->*member) : nullptr;
}

template <typename Value>
Value* find(NoiseRecipe& recipe, const Field<Value>& field) {
  if (Value* const value = find(std::get_if<Gabor>(&recipe.noise), field.gabor)) return value;
  if (Value* const value = find(std::get_if<Oriented>(&recipe.noise), field.oriented)) return value;
  if (Value* const value = find(std::get_if<Kensler>(&recipe.noise), field.kensler)) return value;
  return find(std::get_if<Spectrum>(&recipe.noise), field.spectrum);
}

template <typename Value>
void assign(const std::string& flag, NoiseRecipe& recipe, const Field<Value>& field, const Value& value) {
  Value* const target = find(recipe, field);
  if (!target) throw UsageError(fmt::format("{} does not apply to --noise {}", flag, noise_type(recipe)));
  *target = value;
}

template <typename Value>
void copy_field(NoiseRecipe& from, NoiseRecipe& to, const Field<Value>& field) {
  Value* const source = find(from, field);
  Value* const target = find(to, field);
  if (source && target) *target = *source;
}

// Another noise, with what the old one and it have in common.
void change_noise(NoiseRecipe& recipe, NoiseRecipe changed) {
  copy_field(recipe, changed, kFrequency);
  copy_field(recipe, changed, kBandwidth);
  copy_field(recipe, changed, kError);
  copy_field(recipe, changed, kImpulses);
  copy_field(recipe, changed, kPeriod);
  copy_field(recipe, changed, kSeed);
  recipe = std::move(changed);
}

// The noise of an exemplar's model, which needs no octaves: it has all scales that the exemplar has.
NoiseRecipe noise_by_example(const std::string& file) {
  SpectrumNoiseOptions options;
  read_recipe(file, read_text_file(file),
              [&](const Json& json) { options.model = exemplar_file_from_json(json); });
  return {options, {}};
}

void choose_noise(NoiseRecipe& recipe, const std::string& noise) {
  if (noise.ends_with(".json")) return change_noise(recipe, noise_by_example(noise));
  if (std::find(kNoiseTypes.begin(), kNoiseTypes.end(), noise) == kNoiseTypes.end()) {
    throw UsageError(fmt::format("--noise is {}; it must be one of {}, or FILE.json of noisefit", noise,
                                 fmt::join(kNoiseTypes, ", ")));
  }
  if (noise_type(recipe) == noise) return;
  NoiseRecipe changed = default_noise(noise);
  changed.fractal = recipe.fractal;
  change_noise(recipe, std::move(changed));
}

Vec<4> to_vec4(const std::vector<double>& numbers) {
  Vec<4> vector{0.0};
  for (std::size_t axis = 0; axis < numbers.size(); ++axis) vector[static_cast<int>(axis)] = numbers[axis];
  return vector;
}

void declare_number(FlagSet& flags, NoiseRecipe& recipe, const std::string& flag, const std::string& unit,
                    const std::string& help, const Field<double>& field) {
  flags.number(flag, unit, help, [=, &recipe](double value) { assign(flag, recipe, field, value); });
}

void declare_vector(FlagSet& flags, NoiseRecipe& recipe, const std::string& flag, const std::string& help,
                    const Field<Vec<4>>& field) {
  flags.numbers(flag, "X Y Z [T]", 3, help, [=, &recipe](const std::vector<double>& numbers) {
    assign(flag, recipe, field, to_vec4(numbers));
  });
}

template <typename Enum, std::size_t Count>
void declare_choice(FlagSet& flags, NoiseRecipe& recipe, const std::string& flag,
                    const Choices<Enum, Count>& choices, const std::string& help, const Field<Enum>& field) {
  flags.choice(flag, names_of(choices), help,
               [=, &recipe](std::size_t index) { assign(flag, recipe, field, choices[index].value); });
}

void declare_band(FlagSet& flags, NoiseRecipe& recipe) {
  declare_number(flags, recipe, "--frequency", "CYCLES", "Principal frequency, cycles per world unit",
                 kFrequency);
  flags.number("--size", "UNITS", "Instead: size of a feature, world units; 1 / frequency",
               [&recipe](double size) {
                 require_positive("size", size, "world units");
                 assign("--size", recipe, kFrequency, 1.0 / size);
               });
  flags.exclude({"--frequency", "--size"});
  declare_number(flags, recipe, "--bandwidth", "OCTAVES",
                 "Width of the band at half amplitude, octaves, 0.05 to 4 (default 1)", kBandwidth);
  declare_number(flags, recipe, "--impulses", "N",
                 "Mean impulses under one kernel (default 0: as few as look Gaussian)", kImpulses);
  declare_number(flags, recipe, "--error", "FRACTION",
                 "Relative RMS error that may be made to save time, 0.0001 to 0.5 (default 0.02)", kError);
}

void declare_octaves(FlagSet& flags, FractalOptions& fractal) {
  flags.integer("--octaves", "COUNT", "Octaves, 1 to 16", [&](int value) { fractal.octaves = value; });
  flags.number("--lacunarity", "RATIO", "Frequency of an octave over that of the one before it (default 2)",
               [&](double value) { fractal.lacunarity = value; });
  flags.number("--gain", "RATIO", "Amplitude of an octave over that of the one before it (default 0.5)",
               [&](double value) { fractal.gain = value; });
  flags.toggle("--no-renormalize", "Let the variance grow with the octaves instead of keeping it at 1",
               [&] { fractal.renormalize = false; });
}

void declare_kinds(FlagSet& flags, NoiseRecipe& recipe) {
  declare_choice(flags, recipe, "--weights", kImpulseWeightChoices,
                 "gabor: impulses weigh +1 or -1, or anything between (default signs)", kWeights);
  declare_number(flags, recipe, "--anisotropy", "FRACTION",
                 "gabor-oriented: 0 all directions alike, 1 one direction (default 0)", kAnisotropy);
  declare_vector(flags, recipe, "--direction", "gabor-oriented: where the waves travel (default 1 0 0)",
                 kDirection);
  declare_choice(flags, recipe, "--kernel", kGradientKernelChoices,
                 "kensler: as published, or without power at frequency 0 (default kensler)", kKernel);
  declare_choice(flags, recipe, "--support", kGradientSupportChoices,
                 "kensler: all lattice points, or those of even coordinates (default full)", kSupport);
  declare_choice(flags, recipe, "--hash", kGradientHashChoices,
                 "kensler: as published, repeating every 256 lattice steps, or never (default xor-tables)",
                 kHash);
}

}  // namespace

void change_noise_type(NoiseRecipe& recipe, const std::string& type) {
  choose_noise(recipe, type);
}

void declare_noise_flags(FlagSet& flags, NoiseRecipe& recipe) {
  flags.text("--noise", "KIND",
             "gabor, gabor-oriented or kensler, or FILE.json of noisefit: a noise by example (default gabor)",
             [&recipe](const std::string& noise) { choose_noise(recipe, noise); });
  flags.text("--seed", "INTEGER", "Another seed makes another noise, 0 to 2^64 - 1 (default 0)",
             [&recipe](const std::string& text) {
               assign("--seed", recipe, kSeed, parse_unsigned("--seed", text));
             });
  declare_band(flags, recipe);
  declare_octaves(flags, recipe.fractal);
  declare_vector(flags, recipe, "--period", "Repeat after so many world units along each axis; 0 for never",
                 kPeriod);
  declare_kinds(flags, recipe);
}

void declare_generator_flag(FlagSet& flags, NoiseRecipe& recipe, const int& dims) {
  flags.choice(
      "--generator", {"named", "auto"},
      "gabor, gabor-oriented without anisotropy: the noise that is named, or of the two the one that is "
      "cheaper at the same likeness to a Gaussian field (default named)",
      [&recipe, &dims](std::size_t index) {
        if (index == 0) return;
        if (!has_generators(recipe)) {
          throw UsageError(
              "--generator auto needs --noise gabor with weights of 1 and -1, or gabor-oriented "
              "without anisotropy");
        }
        recipe = cheapest_generator(recipe, dims);
      });
}

}  // namespace solidnoise
