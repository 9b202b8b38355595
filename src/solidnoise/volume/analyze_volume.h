#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/core/cost.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What there is to say about a grid.
struct AnalysisSubject {
  openvdb::FloatGrid::Ptr grid;
  std::optional<VolumeRecipe> recipe;     // that it carries
  std::shared_ptr<const Noise<3>> noise;  // whose values it holds as they are; null: none, or shaped ones
  std::optional<DenseField<3>> block;     // null: no part of it is dense
};

// The subject of a grid: with its recipe, the noise of this, and a block of up to 128 voxels a side, whose
// transform takes about a second and 100 MB. Throws what stored_recipe() does, and std::runtime_error where
// values are not finite.
AnalysisSubject analysis_subject(openvdb::FloatGrid::Ptr grid, const std::string& file);

// What analysing a grid of a file takes, by one thread, with the program itself: known before it is read.
Cost analysis_cost(const GridSummary& grid);

struct AnalysisReport {
  Json json;
  std::vector<RadialBin> spectrum;               // of the block; empty if there is none
  std::optional<SpectrumComparison> comparison;  // with the closed form, where there is a noise
};

// Moments of the active voxels, their histogram beside the Gaussian's, and the radial power spectrum of the
// block, each beside its closed form where there is a noise. Throws Cancelled.
AnalysisReport analyze(const AnalysisSubject& subject, Progress* progress = nullptr);

}  // namespace solidnoise
