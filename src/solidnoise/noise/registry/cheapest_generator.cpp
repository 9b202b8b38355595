#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {
namespace {

// The time that one impulse of an oriented kernel takes, over that of one of an isotropic kernel (bench/, in
// three dimensions at a radius of 16 voxels).
constexpr double kOrientedImpulse = 0.96;

template <typename To, typename From>
To convert(const From& from) {
  To to;
  to.frequency = from.frequency;
  to.bandwidth = from.bandwidth;
  to.error = from.error;
  to.bounds_gradient = from.bounds_gradient;
  to.impulses = from.impulses;
  to.impulses_process = from.impulses_process;
  to.kurtosis = from.kurtosis;
  to.seed = from.seed;
  to.period = from.period;
  to.evolution = from.evolution;
  to.filter = from.filter;
  return to;
}

// Both generators of a recipe; nothing where there is no choice.
struct Candidates {
  GaborNoiseOptions isotropic;
  OrientedGaborNoiseOptions oriented;
};

std::optional<Candidates> candidates(const NoiseRecipe& recipe) {
  if (const auto* isotropic = std::get_if<GaborNoiseOptions>(&recipe.noise)) {
    if (isotropic->weights != ImpulseWeights::signs) return std::nullopt;
    return Candidates{*isotropic, convert<OrientedGaborNoiseOptions>(*isotropic)};
  }
  if (const auto* oriented = std::get_if<OrientedGaborNoiseOptions>(&recipe.noise)) {
    if (oriented->anisotropy != 0.0) return std::nullopt;
    return Candidates{convert<GaborNoiseOptions>(*oriented), *oriented};
  }
  return std::nullopt;
}

template <int Dim>
bool oriented_is_cheaper(const Candidates& both) {
  const double isotropic = GaborNoise<Dim>(both.isotropic).impulses_per_kernel();
  const double oriented = OrientedGaborNoise<Dim>(both.oriented).impulses_per_kernel();
  return kOrientedImpulse * oriented < isotropic;
}

bool oriented_is_cheaper(const Candidates& both, int dimensions) {
  switch (dimensions) {
    case 1:
      return oriented_is_cheaper<1>(both);
    case 2:
      return oriented_is_cheaper<2>(both);
    case 3:
      return oriented_is_cheaper<3>(both);
    case 4:
      return oriented_is_cheaper<4>(both);
    default:
      throw std::invalid_argument(fmt::format("dimensions is {}; it must be 1 to 4", dimensions));
  }
}

}  // namespace

bool has_generators(const NoiseRecipe& recipe) {
  return candidates(recipe).has_value();
}

NoiseRecipe cheapest_generator(const NoiseRecipe& recipe, int dimensions) {
  const std::optional<Candidates> both = candidates(recipe);
  if (!both) return recipe;
  NoiseRecipe cheapest = recipe;
  if (oriented_is_cheaper(*both, dimensions)) {
    cheapest.noise = both->oriented;
  } else {
    cheapest.noise = both->isotropic;
  }
  return cheapest;
}

}  // namespace solidnoise
