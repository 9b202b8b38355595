#pragma once

#include <optional>
#include <string_view>
#include <type_traits>

#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/vdb/grid_file.h"

namespace solidnoise {

// What a grid's values mean where they are not in the parameter's own unit: `low` means `at_low` and `high`
// means `at_high`. Between, the parameter goes linearly with the value, a frequency by equal ratios; beyond
// it stays.
struct ValueMap {
  double low = 0.0;
  double high = 1.0;  // other than low; may be below it
  double at_low = 0.0;
  double at_high = 1.0;

  friend bool operator==(const ValueMap&, const ValueMap&) = default;
};

struct ParameterGrid {
  GridFile source;  // of floats
  std::optional<ValueMap> map;

  // Throws std::invalid_argument where there is no file.
  void validate() const { source.validate(); }

  friend bool operator==(const ParameterGrid&, const ParameterGrid&) = default;
};

// Parameters of a noise that vary in space, from grids. They are looked up at the voxel, in the world, and
// interpolated trilinearly; where a grid has no active voxels its background counts.
//
// Where frequency, bandwidth or direction vary the noise is VaryingGaborNoise: of unit variance everywhere,
// of isotropic kernels or of oriented ones of phase 0, another one than the noise whose parameters are
// constant. The magnitude multiplies whatever noise it is.
struct ParameterGrids {
  std::optional<ParameterGrid> frequency;  // of the first octave, cycles per world unit; > 0
  std::optional<ParameterGrid> bandwidth;  // octaves; 0.1 to 4
  std::optional<ParameterGrid> magnitude;  // standard deviation, in sigmas of the noise; at least 0
  // Where the waves of gabor-oriented travel: vectors (vec3s or vec3d) in the world, of any length. A vector
  // and its opposite are the same direction, also when they are interpolated.
  std::optional<GridFile> direction;

  bool any() const { return vary_kernel() || magnitude.has_value(); }
  bool vary_kernel() const { return frequency || bandwidth || direction; }

  // The name, in a recipe, of the first one that there is: "frequency_grid". Precondition: any().
  std::string_view first_field() const;

  // Throws std::invalid_argument naming the field, its value and what is allowed: also if the noise is none
  // whose kernel can vary, where it has to: one that is not Gabor, evolves, has a period, a filter, weights
  // of any size or waves of some directions more than of others (an anisotropy between 0 and 1).
  void validate(const NoiseRecipe& noise) const;

  friend bool operator==(const ParameterGrids&, const ParameterGrids&) = default;
};

constexpr auto fields_of(std::type_identity<ParameterGrid>) {
  return list_fields(
      part(&ParameterGrid::source),
      field("map", &ParameterGrid::map,
            "Its values LOW and HIGH mean A and B; between, linear, or of a frequency in equal ratios"));
}

constexpr auto fields_of(std::type_identity<ParameterGrids>) {
  using Grids = ParameterGrids;
  return list_fields(
      field("frequency_grid", &Grids::frequency,
            "Gabor noises: frequency at each voxel (floats), cycles per world unit"),
      field("bandwidth_grid", &Grids::bandwidth,
            "Gabor noises: bandwidth at each voxel (floats), 0.1 to 4 octaves"),
      field("magnitude_grid", &Grids::magnitude,
            "Standard deviation at each voxel (floats), in sigmas of the noise"),
      field(
          "direction_grid", &Grids::direction,
          "Where the waves travel at each voxel (vec3s or vec3d), of gabor-oriented noise of anisotropy 1"));
}

}  // namespace solidnoise
