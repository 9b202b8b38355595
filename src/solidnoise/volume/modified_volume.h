#pragma once

#include <functional>
#include <optional>

#include "solidnoise/core/progress.h"
#include "solidnoise/volume/modify/modify_volume.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Reads what a recipe modifies, as plan_modification, and refuses what it cannot be modified with: shaped
// noise where there are only points (std::invalid_argument).
ModificationPlan plan_modification(const VolumeRecipe& recipe, Progress* progress = nullptr);

// Voxels that are made, about.
double estimate_voxels(const VolumeRecipe& recipe, const ModificationPlan& plan);

// Bytes that it takes at most.
std::uint64_t estimate_memory(const VolumeRecipe& recipe, const ModificationPlan& plan);

// How the field of a recipe is made.
using MakeModifyingField = std::function<FieldPtr(const VolumeRecipe&)>;

// The factor of densities that replace the grid's values, as measure_density_factor() of make_volume.h gives
// it; nothing where they are all 0.
std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const ModificationPlan& plan,
                                             const MakeModifyingField& make_field, Progress* progress);

// Whether a modification takes densities that are scaled: shaped noise that replaces values.
bool scales_density(const VolumeRecipe& recipe, const Modification& modification);

// The modified grid, with the recipe in its metadata beside what it had, and the file that it is from.
Volume make_modified_volume(const VolumeRecipe& recipe, const ModificationPlan& plan,
                            const MakeModifyingField& make_field, Progress* progress);

}  // namespace solidnoise
