#pragma once

#include <iosfwd>
#include <string>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Writes a line where the voxels do not suit the noise: they cannot hold its frequencies, or its period is
// not a whole number of them.
void warn_of_resolution(const VolumeRecipe& recipe, const VolumePlan& plan, std::ostream& stream);

// Refuses names that outputs cannot have: a grid's must end in .vdb or be "-", which may not be a terminal, a
// picture's in .png. Empty ones are none. Throws UsageError that names the flag.
void check_output_names(const std::string& out, const std::string& preview);

// Whether none of its grids has a voxel.
bool is_empty(const Volume& volume);
// Whether it has values, all of them 0.
bool is_zero(const Volume& volume);
// Whether it has values, all of a grid's the same.
bool is_constant(const Volume& volume);

// Tells on the standard error what a file holds.
void print_statistics(const Volume& volume, const std::string& where);

}  // namespace solidnoise
