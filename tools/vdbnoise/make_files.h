#pragma once

#include "solidnoise/volume/volume_cost.h"
#include "vdbnoise/make_options.h"
#include "vdbnoise/usd_output.h"

namespace solidnoise {

// What becomes of the volumes.
Target target_of(const MakeOptions& options);

// Refuses outputs of one volume that could not be written in the end, before any work. Throws as
// require_outputs().
void check_outputs(const MakeOptions& options);

// Makes one volume and its files, all of them or none; adds it to the scene of a sequence, if there is one.
// For a process that has called catch_interrupts().
void make_volume_files(const MakeOptions& options, UsdScene* scene = nullptr);

// Measures the factor by which the densities of all frames of a sequence are scaled, at the recipe's own
// time, and puts it into the recipe: of each of its grids for which it is to be measured.
void measure_density_factors(MakeOptions& options);

}  // namespace solidnoise
