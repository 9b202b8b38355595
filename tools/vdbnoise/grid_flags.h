#pragma once

#include <string>
#include <vector>

#include "common/flag_form.h"
#include "common/flag_set.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// "FILE.vdb" or "FILE.vdb:GRID"; the file with its whole path, so that a recipe can be used from any folder.
template <>
struct FlagForm<GridFile> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "FILE.vdb[:GRID]"; }
  static GridFile read(const std::string& flag, const std::vector<std::string>& texts);
  static std::string write(const GridFile& source);
};

template <>
struct FlagForm<ParameterGrid> : FlagForm<GridFile> {
  static ParameterGrid read(const std::string& flag, const std::vector<std::string>& texts) {
    return {FlagForm<GridFile>::read(flag, texts), {}};
  }
  static std::string write(const ParameterGrid& grid) { return FlagForm<GridFile>::write(grid.source); }
};

template <typename Visit>
void for_each_number(const ValueMap& map, const Visit& visit) {
  for (const double number : {map.low, map.high, map.at_low, map.at_high}) visit(number);
}
template <>
struct FlagForm<ValueMap> : NumbersForm<ValueMap, 4> {
  static std::string names(std::string_view) { return "LOW HIGH A B"; }
};

// "box", "sphere", "ellipsoid", "bunny.obj", "smoke.vdb" or "smoke.vdb:density".
template <>
struct FlagForm<Shape> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "box|sphere|ellipsoid|FILE"; }
  static Shape read(const std::string& flag, const std::vector<std::string>& texts);
  static std::string write(const Shape& shape);
};

// Declares --frequency-grid and its like. To be applied after the flags of the noise.
void declare_parameter_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses a constant beside a grid, which would be without effect. Throws UsageError.
void check_parameter_flags(const FlagSet& flags, const VolumeRecipe& recipe);

// Declares the flags for grids that exist, --on and those that go with it.
void declare_modify_flags(FlagSet& flags, VolumeRecipe& recipe);

// Refuses those without --on, and the flags that have no effect with it. Throws UsageError.
void check_modify_flags(const FlagSet& flags, const VolumeRecipe& recipe);

}  // namespace solidnoise
