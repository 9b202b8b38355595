#include "solidnoise/volume/parameters/parameter_grids.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/parameters/parameter_range.h"

namespace solidnoise {
namespace {

void validate_map(const std::string& field, const std::optional<ParameterGrid>& grid,
                  const ParameterRange& range) {
  if (!grid || !grid->map) return;
  const ValueMap& map = *grid->map;
  for (const double value : {map.low, map.high}) require_finite(field, value);
  if (map.low == map.high) {
    throw std::invalid_argument(
        fmt::format("{} is from {} to {}; the two values of the grid must differ", field, map.low, map.high));
  }
  for (const double value : {map.at_low, map.at_high}) {
    if (!range.allows(value)) {
      throw std::invalid_argument(fmt::format("{} goes to {}; it must be {}", field, value, range.allowed));
    }
  }
}

double filter_of(const NoiseRecipe& recipe) {
  const auto find = [](const auto& options) {
    if constexpr (requires { options.filter; }) return options.filter;
    return 0.0;
  };
  return std::visit(find, recipe.noise);
}

// What noise there is, if it is none that can vary.
std::string unfit(const NoiseRecipe& recipe) {
  constexpr char kWhat[] = "; it must be gabor or gabor-oriented";
  if (std::holds_alternative<GradientNoiseOptions>(recipe.noise))
    return fmt::format("kensler noise{}", kWhat);
  if (std::holds_alternative<SpectrumNoiseOptions>(recipe.noise)) {
    return fmt::format("a noise by example{}", kWhat);
  }
  if (evolves(recipe)) return "noise that evolves; dims 4 changes with time too";
  if (std::visit([](const auto& options) { return options.period != Vec<4>(0.0); }, recipe.noise)) {
    return "noise that has a period";
  }
  if (filter_of(recipe) != 0.0) return "noise that is filtered";
  if (const auto* const gabor = std::get_if<GaborNoiseOptions>(&recipe.noise)) {
    return gabor->weights == ImpulseWeights::uniform ? "uniform weights" : "";
  }
  const double anisotropy = std::get<OrientedGaborNoiseOptions>(recipe.noise).anisotropy;
  if (anisotropy != 0.0 && anisotropy != 1.0) {
    return fmt::format("an anisotropy of {}; it must be 0, all directions alike, or 1, one direction",
                       anisotropy);
  }
  return "";
}

}  // namespace

std::string_view ParameterGrids::first_field() const {
  if (frequency) return "frequency_grid";
  if (bandwidth) return "bandwidth_grid";
  return direction ? "direction_grid" : "magnitude_grid";
}

void ParameterGrids::validate(const NoiseRecipe& noise) const {
  validate_map("frequency_map", frequency, kFrequencyRange);
  validate_map("bandwidth_map", bandwidth, kBandwidthRange);
  validate_map("magnitude_map", magnitude, kMagnitudeRange);
  if (!vary_kernel()) return;
  const std::string_view field = first_field();
  if (const std::string why = unfit(noise); !why.empty()) {
    throw std::invalid_argument(fmt::format("{} does not go with {}", field, why));
  }
  const auto* const oriented = std::get_if<OrientedGaborNoiseOptions>(&noise.noise);
  if (direction && !(oriented && oriented->anisotropy == 1.0)) {
    throw std::invalid_argument(
        "direction_grid needs waves of one direction: noise gabor-oriented of anisotropy 1");
  }
  if (!bandwidth) {
    const double constant = std::visit(
        [](const auto& options) {
          if constexpr (requires { options.bandwidth; }) return options.bandwidth;
          return 1.0;
        },
        noise.noise);
    if (!kBandwidthRange.allows(constant)) {
      throw std::invalid_argument(fmt::format("bandwidth is {}; where there is a {} it must be {}", constant,
                                              field, kBandwidthRange.allowed));
    }
  }
}

}  // namespace solidnoise
