#include "solidnoise/volume/parameters/parameter_grids.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/volume/parameters/scalar_field.h"

namespace solidnoise {
namespace {

void validate_map(const std::string& field, const std::optional<ParameterGrid>& grid,
                  const AllowedValues& range) {
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

// What noise there is, if it is none that can vary.
std::string unfit(const NoiseRecipe& recipe) {
  const auto say = [&]<typename Options>(const Options& options) -> std::string {
    if constexpr (CanVary<Options>) {
      if (evolves(recipe)) return "noise that evolves; dims 4 changes with time too";
      if (options.period != Vec<4>(0.0)) return "noise that has a period";
      if constexpr (CanFilter<Options>) {
        if (options.filter != 0.0) return "noise that is filtered";
      }
      return NoiseEntry<Options>::why_fixed(options);
    } else {
      const auto fit = noise_names([]<typename Other>(std::type_identity<Other>) { return CanVary<Other>; });
      return fmt::format("{}; it must be {}", NoiseEntry<Options>::kTitle, fmt::join(fit, " or "));
    }
  };
  return std::visit(say, recipe.noise);
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
