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

// One grid of a volume's file.
struct OutputGrid {
  VolumeRecipe single;  // the short form that it is of
  Output output = Output::value;
  std::string name;

  bool is_density() const;  // else its values are raw
};
// In their order.
std::vector<OutputGrid> output_grids(const VolumeRecipe& recipe);

// What finish_volume() does to the metadata of one of them, but for statistics and the factor of a density.
void name_grid(const OutputGrid& of, const std::string& creator, openvdb::GridBase& grid);

// What it does to one grid's values: gives the factor, which is the recipe's own where it has one, or 1 for a
// grid of zeros.
double scale_density(const VolumeRecipe& recipe, openvdb::FloatGrid& grid, Moments& moments);
// The factor of a volume whose largest value is `peak` and whose thickest column along the up axis is
// `thickest`; nothing where they are 0.
std::optional<double> density_factor(const DensityScale& density, double peak, double thickest);

// Leaves out the voxels of a density that are below a value.
void drop_below(float least, openvdb::FloatGrid& grid);

// What it does to one grid's metadata beside name and creator.
void note_recipe(const VolumeRecipe& recipe, const std::vector<Moments>& moments, openvdb::GridBase& grid);
void note_density_factor(double factor, openvdb::GridBase& grid);

// Whether a grid that a file held has as many voxels, of the moments, as its metadata say: within rounding,
// which is that of half floats where it was stored as these. Grids of other types have.
bool is_as_noted(const openvdb::GridBase& grid);

// Names of the metadata of a grid that hold its recipe, as JSON, and which part of a volume it is.
inline constexpr char kRecipeKey[] = "solidnoise:recipe";
inline constexpr char kPartKey[] = "solidnoise:part";

}  // namespace solidnoise
