#include "vdbnoise/volume_output.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <ostream>

#include <fmt/format.h>

#include "common/noise_flags.h"
#include "common/outputs.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/noise/evolution.h"
#include "solidnoise/noise/interpolation/lattice_frame.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

// Frequencies that the voxels cannot hold come back as others.
void warn_of_aliasing(const VolumeRecipe& recipe, const VolumePlan& plan, std::ostream& stream) {
  constexpr double kHighestCyclesPerVoxel = 0.5;
  if (recipe.band_limit) return;
  const Vec<3>& voxel = plan.frame.voxel_size();
  const double highest = highest_frequency(recipe, plan) * std::max({voxel.x, voxel.y, voxel.z});
  if (highest <= kHighestCyclesPerVoxel) return;
  const bool has_own_voxels = !plan.modification && !plan.grid;
  stream << fmt::format(
      "vdbnoise: warning: the noise reaches {:.2f} cycles per voxel, above 0.5, and will alias; {}make "
      "{}--frequency lower or --octaves fewer\n",
      highest, may_band_limit(recipe) ? "give --band-limit, or " : "",
      has_own_voxels ? "--voxel smaller, " : "");
}

// Tiles meet where the period is a whole number of voxels. Returns whether there was a warning.
bool warn_of_tiles(const NoiseRecipe& noise, const Vec<3>& voxel, std::ostream& stream) {
  const Vec<4> period = period_of(noise);
  for (int axis = 0; axis < 3; ++axis) {
    if (period[axis] == 0.0 || whole_period(period[axis], voxel[axis]) > 0) continue;
    const double voxels = period[axis] / voxel[axis];
    stream << fmt::format(
        "vdbnoise: warning: the period is {} along {}, {:.6g} voxels; tiles meet where it is a whole number "
        "of "
        "them: --voxel {:.9g}\n",
        period[axis], "xyz"[axis], voxels, period[axis] / std::max(1.0, std::round(voxels)));
    return true;
  }
  return false;
}

// Of the noise, or of the first of the layers' that does not fit.
void warn_of_tiles(const VolumeRecipe& recipe, const Vec<3>& voxel, std::ostream& stream) {
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    for (const NoiseRecipe& noise : noises_of(single)) {
      if (warn_of_tiles(noise, voxel, stream)) return;
    }
  }
}

void warn_of_loop(const VolumeRecipe& recipe, std::ostream& stream) {
  for (const NoiseRecipe& noise : noises_of(recipe)) {
    const Evolution* const evolution = evolution_of(noise);
    const std::string warning = evolution ? loop_warning(*evolution) : std::string();
    if (warning.empty()) continue;
    stream << "vdbnoise: warning: " << warning;
    return;
  }
}

}  // namespace

void warn_of_resolution(const VolumeRecipe& recipe, const VolumePlan& plan, std::ostream& stream) {
  warn_of_aliasing(recipe, plan, stream);
  warn_of_tiles(recipe, plan.frame.voxel_size(), stream);
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    warn_of_loop(single, stream);
  }
}

namespace {

void print_statistics(const MeasuredGrid& measured, const std::string& where) {
  const openvdb::Vec3d size = measured.grid->voxelSize();
  const openvdb::Coord dim = measured.grid->evalActiveVoxelDim();
  std::cerr << fmt::format("{}: grid {}, {} active voxels in {} x {} x {}, voxel size {:.6g}\n",
                           printable(where), printable(measured.grid->getName()),
                           measured.moments.front().count(), dim.x(), dim.y(), dim.z(), size.x());
  const bool is_vector = measured.moments.size() > 1;
  double mean_square = 0.0;
  for (std::size_t i = 0; i < measured.moments.size(); ++i) {
    const Moments& moments = measured.moments[i];
    std::cerr << (is_vector ? fmt::format("{}: ", "xyz"[i]) : "")
              << fmt::format("min {:.6g}  max {:.6g}  mean {:.6g}  sigma {:.6g}\n", moments.min(),
                             moments.max(), moments.mean(), moments.sigma());
    mean_square += moments.mean() * moments.mean() + moments.sigma() * moments.sigma();
  }
  if (is_vector) std::cerr << fmt::format("root mean square length {:.6g}\n", std::sqrt(mean_square));
}

}  // namespace

void check_output_names(const std::string& out, const std::string& preview) {
  require_extension("--out", out, {".vdb"}, StandardOutput::allowed);
  require_extension("--preview", preview, {".png"}, StandardOutput::refused);
  require_no_terminal("--out", out);
}

bool is_zero(const Volume& volume) {
  const auto is_zero = [](const Moments& moments) { return moments.min() == 0.0 && moments.max() == 0.0; };
  return !is_empty(volume) && std::ranges::all_of(volume.grids, [&](const MeasuredGrid& measured) {
    return std::ranges::all_of(measured.moments, is_zero);
  });
}

bool is_constant(const Volume& volume) {
  const auto is_constant = [](const Moments& moments) { return moments.min() == moments.max(); };
  return std::ranges::all_of(volume.grids, [&](const MeasuredGrid& measured) {
    return measured.moments.front().count() > 1 && std::ranges::all_of(measured.moments, is_constant);
  });
}

bool is_empty(const Volume& volume) {
  return std::ranges::all_of(
      volume.grids, [](const MeasuredGrid& measured) { return measured.moments.front().count() == 0; });
}

void print_statistics(const Volume& volume, const std::string& where) {
  for (const MeasuredGrid& measured : volume.grids) print_statistics(measured, where);
}

}  // namespace solidnoise
