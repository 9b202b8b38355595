#include "solidnoise/noise/noise_recipe.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"

namespace solidnoise {
namespace {

template <int Dim>
std::unique_ptr<Noise<Dim>> make_single(const GaborNoiseOptions& options) {
  return std::make_unique<GaborNoise<Dim>>(options);
}

template <int Dim>
std::unique_ptr<Noise<Dim>> make_single(const OrientedGaborNoiseOptions& options) {
  return std::make_unique<OrientedGaborNoise<Dim>>(options);
}

template <int Dim>
std::unique_ptr<Noise<Dim>> make_single(const GradientNoiseOptions& options) {
  return std::make_unique<GradientNoise<Dim>>(options);
}

template <int Dim>
std::unique_ptr<Noise<Dim>> make_single(const SpectrumNoiseOptions& options) {
  if constexpr (Dim == 2 || Dim == 3) {
    return std::make_unique<SpectrumNoise<Dim>>(options);
  } else {
    throw std::invalid_argument(fmt::format("a noise by example has 2 or 3 dimensions, not {}", Dim));
  }
}

}  // namespace

void NoiseRecipe::validate() const {
  fractal.validate();
  std::visit(
      [this](const auto& options) {
        options.validate();
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
        options.frequency *= std::pow(recipe.fractal.lacunarity, k);
        if (k > 0) options.seed = derive_seed(options.seed, kOctaveStream + static_cast<std::uint64_t>(k));
      },
      octave.noise);
  if (Evolution* const evolution = evolution_of(octave)) {
    *evolution = evolution_of_octave(*evolution, std::pow(recipe.fractal.lacunarity, k));
  }
  return octave;
}

const Evolution* evolution_of(const NoiseRecipe& recipe) {
  const auto find = [](const auto& options) -> const Evolution* {
    if constexpr (requires { options.evolution; }) {
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
  return std::visit(
      [](const auto& options) {
        return requires {
          options.filter;
        };
      },
      recipe.noise);
}

NoiseRecipe filtered(const NoiseRecipe& recipe, double deviation) {
  NoiseRecipe result = recipe;
  std::visit(
      [deviation](auto& options) {
        if constexpr (requires { options.filter; }) {
          options.filter = std::hypot(options.filter, deviation);
        } else {
          throw std::invalid_argument(
              fmt::format("filter is {}; it must be 0 for noises but gabor and gabor-oriented", deviation));
        }
      },
      result.noise);
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
  if (!std::holds_alternative<OrientedGaborNoiseOptions>(recipe.noise)) {
    throw std::invalid_argument("the noise has neither phase nor intensity; it must be gabor-oriented");
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
  const auto& options = std::get<OrientedGaborNoiseOptions>(recipe.noise);
  return std::make_unique<OrientedGaborNoise<Dim>>(with_truncation_share(options), -0.25);
}

template std::unique_ptr<Noise<1>> make_noise<1>(const NoiseRecipe&);
template std::unique_ptr<Noise<2>> make_noise<2>(const NoiseRecipe&);
template std::unique_ptr<Noise<3>> make_noise<3>(const NoiseRecipe&);
template std::unique_ptr<Noise<4>> make_noise<4>(const NoiseRecipe&);
template std::unique_ptr<Noise<2>> make_quadrature<2>(const NoiseRecipe&);
template std::unique_ptr<Noise<3>> make_quadrature<3>(const NoiseRecipe&);
template std::unique_ptr<Noise<4>> make_quadrature<4>(const NoiseRecipe&);

}  // namespace solidnoise
