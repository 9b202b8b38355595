#include "solidnoise/noise/registry/noise_recipe.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/registry/noise_entries.h"

namespace solidnoise {
namespace {

// What it is called in a message.
template <typename Options>
std::string band_of(const Options& options) {
  if constexpr (requires { options.bandwidth; }) return fmt::format("bandwidth is {}, ", options.bandwidth);
  return "the noise has a spectrum ";
}

template <int Dim, typename Options>
std::unique_ptr<Noise<Dim>> make_single(const Options& options) {
  using Entry = NoiseEntry<Options>;
  if constexpr (Entry::kLeastDimensions <= Dim && Dim <= Entry::kMostDimensions) {
    auto noise = std::make_unique<typename Entry::template Noise<Dim>>(options);
    if constexpr (requires { noise->impulses_per_kernel(); }) {
      if (options.impulses == 0.0 && noise->impulses_per_kernel() > kImpulses.most) {
        throw std::invalid_argument(fmt::format(
            "{}which takes {:.0f} impulses per kernel in {} dimensions, of at most {}; give fewer, "
            "or a wider band",
            band_of(options), noise->impulses_per_kernel(), Dim, kImpulses.most));
      }
    }
    return noise;
  } else {
    throw std::invalid_argument(fmt::format("{} has {} to {} dimensions, not {}", Entry::kTitle,
                                            Entry::kLeastDimensions, Entry::kMostDimensions, Dim));
  }
}

// Those for which a test of their options' type is true: "gabor and gabor-oriented".
template <typename Test>
std::string list_noises(const char* separator, const Test& test) {
  return fmt::format("{}", fmt::join(noise_names(test), separator));
}

}  // namespace

void NoiseRecipe::validate() const {
  fractal.validate();
  std::visit(
      [this](const auto& options) {
        options.validate();
        const double highest = options.frequency * fractal.frequency_ratio(fractal.octaves - 1);
        if (highest > kFrequencies.most) {
          throw std::invalid_argument(
              fmt::format("frequency is {}, and {:.6g} in the last of {} octaves; it must be at most {}",
                          options.frequency, highest, fractal.octaves, kFrequencies.most));
        }
        const bool whole = fractal.lacunarity == std::floor(fractal.lacunarity);
        if (options.period != Vec<4>(0.0) && fractal.octaves > 1 && !whole) {
          throw std::invalid_argument(fmt::format(
              "lacunarity is {}; it must be a whole number where there is a period and several octaves",
              fractal.lacunarity));
        }
      },
      noise);
}

std::uint64_t seed_of(const NoiseRecipe& recipe) {
  return std::visit([](const auto& options) { return options.seed; }, recipe.noise);
}

Vec<4> period_of(const NoiseRecipe& recipe) {
  return std::visit([](const auto& options) { return options.period; }, recipe.noise);
}

double error_of(const NoiseRecipe& recipe) {
  return std::visit(
      [](const auto& options) {
        if constexpr (requires { options.error; }) {
          return options.error;
        } else {
          return 0.0;
        }
      },
      recipe.noise);
}

NoiseRecipe octave_of(const NoiseRecipe& recipe, int k) {
  NoiseRecipe octave = recipe;
  octave.fractal.octaves = 1;
  std::visit(
      [&](auto& options) {
        options.frequency *= recipe.fractal.frequency_ratio(k);
        if (k > 0) options.seed = derive_seed(options.seed, kOctaveStream + static_cast<std::uint64_t>(k));
        if constexpr (requires { options.kurtosis; }) {
          options.kurtosis = recipe.fractal.kurtosis_of_octave(k, options.kurtosis);
        }
      },
      octave.noise);
  if (Evolution* const evolution = evolution_of(octave)) {
    *evolution = evolution_of_octave(*evolution, recipe.fractal.frequency_ratio(k));
  }
  return octave;
}

const Evolution* evolution_of(const NoiseRecipe& recipe) {
  const auto find = []<typename Options>(const Options& options) -> const Evolution* {
    if constexpr (CanEvolve<Options>) {
      return &options.evolution;
    } else {
      return nullptr;
    }
  };
  return std::visit(find, recipe.noise);
}

Evolution* evolution_of(NoiseRecipe& recipe) {
  return const_cast<Evolution*>(evolution_of(std::as_const(recipe)));
}

bool evolves(const NoiseRecipe& recipe) {
  const Evolution* const evolution = evolution_of(recipe);
  return evolution && evolution->moves();
}

NoiseRecipe at_time(const NoiseRecipe& recipe, double time) {
  NoiseRecipe moved = recipe;
  if (evolves(moved)) evolution_of(moved)->time = time;
  return moved;
}

bool can_filter(const NoiseRecipe& recipe) {
  return std::visit([]<typename Options>(const Options&) { return CanFilter<Options>; }, recipe.noise);
}

NoiseRecipe filtered(const NoiseRecipe& recipe, double deviation) {
  NoiseRecipe result = recipe;
  std::visit(
      [deviation]<typename Options>(Options& options) {
        if constexpr (CanFilter<Options>) {
          options.filter = std::hypot(options.filter, deviation);
        } else {
          constexpr auto can = []<typename Other>(std::type_identity<Other>) { return CanFilter<Other>; };
          throw std::invalid_argument(fmt::format("filter is {}; it must be 0 for noises but {}", deviation,
                                                  list_noises(" and ", can)));
        }
      },
      result.noise);
  return result;
}

NoiseRecipe bounding_gradient(const NoiseRecipe& recipe) {
  NoiseRecipe result = recipe;
  const auto bound = [](auto& options) {
    if constexpr (requires { options.bounds_gradient; }) options.bounds_gradient = true;
  };
  std::visit(bound, result.noise);
  return result;
}

NoiseRecipe channel_of(const NoiseRecipe& recipe, int channel) {
  NoiseRecipe other = recipe;
  const std::uint64_t stream = kChannelStream + static_cast<std::uint64_t>(channel);
  std::visit([&](auto& options) { options.seed = derive_seed(options.seed, stream); }, other.noise);
  if (auto* const spectrum = std::get_if<SpectrumNoiseOptions>(&other.noise)) {
    spectrum->channel = channel % static_cast<int>(spectrum->model.channels.size());
  }
  return other;
}

template <int Dim>
std::unique_ptr<Noise<Dim>> make_noise(const NoiseRecipe& recipe) {
  recipe.validate();
  const FractalOptions& fractal = recipe.fractal;
  if (fractal.octaves == 1) {
    return std::visit([](const auto& options) { return make_single<Dim>(with_truncation_share(options)); },
                      recipe.noise);
  }
  const std::vector<double> amplitudes = fractal.amplitudes();
  std::vector<typename FractalNoise<Dim>::Octave> octaves;
  for (int k = 0; k < fractal.octaves; ++k) {
    auto noise = make_noise<Dim>(octave_of(recipe, k));
    if (noise->variance() == 0.0) continue;  // nothing passes the filter
    octaves.push_back({std::move(noise), amplitudes[static_cast<std::size_t>(k)]});
  }
  return std::make_unique<FractalNoise<Dim>>(std::move(octaves));
}

void require_phase(const NoiseRecipe& recipe) {
  constexpr auto has = []<typename Options>(std::type_identity<Options>) { return HasPhase<Options>; };
  const bool is_there = std::visit(
      [&]<typename Options>(const Options&) { return has(std::type_identity<Options>()); }, recipe.noise);
  if (!is_there) {
    throw std::invalid_argument("the noise has neither phase nor intensity; it must be " +
                                list_noises(" or ", has));
  }
  if (recipe.fractal.octaves != 1) {
    throw std::invalid_argument(fmt::format(
        "octaves is {}; it must be 1 for phase and intensity: of several octaves, each has its own",
        recipe.fractal.octaves));
  }
}

template <int Dim>
std::unique_ptr<Noise<Dim>> make_quadrature(const NoiseRecipe& recipe) {
  recipe.validate();
  require_phase(recipe);
  constexpr double kQuarterWave = -0.25;
  return std::visit(
      [&]<typename Options>(const Options& options) -> std::unique_ptr<Noise<Dim>> {
        if constexpr (HasPhase<Options>) {
          using Made = typename NoiseEntry<Options>::template Noise<Dim>;
          return std::make_unique<Made>(with_truncation_share(options), kQuarterWave);
        }
        return nullptr;  // refused above
      },
      recipe.noise);
}

template std::unique_ptr<Noise<1>> make_noise<1>(const NoiseRecipe&);
template std::unique_ptr<Noise<2>> make_noise<2>(const NoiseRecipe&);
template std::unique_ptr<Noise<3>> make_noise<3>(const NoiseRecipe&);
template std::unique_ptr<Noise<4>> make_noise<4>(const NoiseRecipe&);
template std::unique_ptr<Noise<2>> make_quadrature<2>(const NoiseRecipe&);
template std::unique_ptr<Noise<3>> make_quadrature<3>(const NoiseRecipe&);
template std::unique_ptr<Noise<4>> make_quadrature<4>(const NoiseRecipe&);

}  // namespace solidnoise
