#pragma once

#include <memory>
#include <optional>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/openvdb.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What there is to say about a grid.
struct AnalysisSubject {
  openvdb::FloatGrid::Ptr grid;
  std::optional<VolumeRecipe> recipe;     // that it carries
  std::shared_ptr<const Noise<3>> noise;  // whose values it holds as they are; null: none, or shaped ones
  std::optional<DenseField<3>> block;     // null: no part of it is dense
};

// Moments of the active voxels, their histogram beside the Gaussian's, and the radial power spectrum of the
// block, each beside its closed form where there is a noise.
Json analysis_report(const AnalysisSubject& subject);

}  // namespace solidnoise
