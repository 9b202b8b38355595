#pragma once

#include <cmath>
#include <string_view>
#include <type_traits>

#include "solidnoise/noise/cellular/cellular_noise.h"
#include "solidnoise/noise/cellular/cellular_noise_options.h"
#include "solidnoise/noise/noise_entry.h"

namespace solidnoise {

inline constexpr Choices<CellularNoiseOptions::Feature, 2> kCellularFeatureChoices{{
    {CellularNoiseOptions::Feature::distance, "distance"},
    {CellularNoiseOptions::Feature::border, "border"},
}};

constexpr auto fields_of(std::type_identity<CellularNoiseOptions>) {
  using Options = CellularNoiseOptions;
  return list_fields(fields_of_frequency<Options>(),
                     field("feature", &Options::feature, kCellularFeatureChoices,
                           "Distance to the nearest point, or by how much the second is farther"),
                     fields_of_place<Options>());
}

template <>
struct NoiseEntry<CellularNoiseOptions> {
  static constexpr std::string_view kName = "cellular";
  static constexpr std::string_view kTitle = "cellular noise";
  static constexpr std::string_view kHelp = "Distances to scattered points: cells, pebbles, cracks";
  static constexpr int kLeastDimensions = 1;
  static constexpr int kMostDimensions = 4;
  template <int Dim>
  using Noise = CellularNoise<Dim>;

  template <int Dim>
  static void describe(const CellularNoiseOptions& options, const auto& of_kernel, const auto& of_noise) {
    const CellularNoise<Dim> noise(options);
    of_kernel("kind", "nearest points");
    of_kernel("frequency", options.frequency);
    of_kernel("radius", noise.radius());
    of_noise("points_per_cell", noise.points().mean_per_cell());
  }

  // The values around a single point.
  template <int Dim>
  static KernelSlice slice(const CellularNoiseOptions& options) {
    const double radius = CellularNoise<Dim>(options).radius();
    return {radius, [radius](double x, double y) { return std::hypot(x, y) / radius - 1.0; }};
  }
};

}  // namespace solidnoise
