#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Makes of the values of a whole volume what its file holds: scales densities as the recipe asks (which needs
// all of the volume), names the grids, sets their classes, and notes the recipe, `creator`, seed, up axis,
// algorithm version and statistics in their metadata. The recipe is noted as it is: its files are to have
// their digests.
void finish_volume(const VolumeRecipe& recipe, const std::string& creator, Volume& volume);

// What it does to one grid's values: gives the factor, which is the recipe's own where it has one, or 1 for a
// grid of zeros.
double scale_density(const VolumeRecipe& recipe, openvdb::FloatGrid& grid, Moments& moments);
// The factor of a volume whose largest value is `peak` and whose thickest column along the up axis is
// `thickest`; nothing where they are 0.
std::optional<double> density_factor(const DensityScale& density, double peak, double thickest);

// What it does to one grid's metadata beside name and creator.
void note_recipe(const VolumeRecipe& recipe, const std::vector<Moments>& moments, openvdb::GridBase& grid);
void note_density_factor(double factor, openvdb::GridBase& grid);

// Names of the metadata of a grid that hold its recipe, as JSON, and which part of a volume it is.
inline constexpr char kRecipeKey[] = "solidnoise:recipe";
inline constexpr char kPartKey[] = "solidnoise:part";

}  // namespace solidnoise
