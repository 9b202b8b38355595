#pragma once

#include <string>

#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Makes of the values of a whole volume what its file holds: scales densities as the recipe asks (which needs
// all of the volume), names the grids, sets their classes, and notes the recipe, `creator`, seed, up axis,
// algorithm version and statistics in their metadata. The recipe is noted as it is: its files are to have
// their digests.
void finish_volume(const VolumeRecipe& recipe, const std::string& creator, Volume& volume);

// What it does to one grid's values, and to one grid's metadata beside name and creator.
void scale_density(const VolumeRecipe& recipe, openvdb::FloatGrid& grid, Moments& moments);
void note_recipe(const VolumeRecipe& recipe, const std::vector<Moments>& moments, openvdb::GridBase& grid);

// Name of the metadata of a grid that holds its recipe, as JSON.
inline constexpr char kRecipeKey[] = "solidnoise:recipe";

}  // namespace solidnoise
