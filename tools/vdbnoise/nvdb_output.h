#pragma once

#include <vector>

#include "common/flag_set.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume.h"
#include "vdbnoise/make_options.h"

namespace solidnoise {

// Whether a volume goes to a .nvdb.
bool is_nvdb(const MakeOptions& options);

// Refuses what has no effect on the output's format. Throws UsageError.
void check_format(const FlagSet& flags, const MakeOptions& options);

// Bytes that a .nvdb takes before it is written: at most, of all voxels.
double nvdb_bytes(const VolumeRecipe& recipe, const VolumePlan& plan);

// Tells on the standard error what a .nvdb keeps of the values, whose differences write_nvdb() has returned,
// and that it keeps no recipe.
void print_nvdb_errors(const MakeOptions& options, const Volume& volume, const std::vector<double>& errors);

}  // namespace solidnoise
