#include "solidnoise/volume/preview/picture.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/preview/matter_preview.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/preview/slice_preview.h"
#include "solidnoise/volume/preview/solid_preview.h"

namespace solidnoise {
namespace {

using FloatPtr = openvdb::FloatGrid::ConstPtr;

// All of the planned voxels, as they are before empty ones are dropped.
openvdb::FloatGrid::Ptr full_grid(const VolumePlan& plan) {
  const auto grid = openvdb::FloatGrid::create();
  grid->setTransform(plan.frame.transform());
  grid->sparseFill(plan.voxels, 1.0f);
  return grid;
}

// Null if there is no such grid of floats.
FloatPtr grid_named(const Volume& volume, std::string_view name) {
  const auto found = std::ranges::find_if(
      volume.grids, [&](const MeasuredGrid& measured) { return measured.grid->getName() == name; });
  return found == volume.grids.end() ? nullptr : openvdb::gridPtrCast<openvdb::FloatGrid>(found->grid);
}

PreviewLook look_of(const Volume& volume, const VolumeRecipe& recipe, const openvdb::FloatGrid& first) {
  if (recipe.look != PreviewLook::automatic) return recipe.look;
  if (grid_named(volume, "temperature")) return PreviewLook::fire;
  return first.getGridClass() == openvdb::GRID_FOG_VOLUME ? PreviewLook::cloud : PreviewLook::solid;
}

// Noise has the colours of 3 standard deviations to both sides of its mean, or of its range.
SolidLook noise_look(const VolumeRecipe& recipe) {
  SolidLook look{ColorRamp({{0.0f, {0.05f, 0.10f, 0.22f}},
                            {0.3f, {0.20f, 0.43f, 0.58f}},
                            {0.5f, {0.90f, 0.87f, 0.80f}},
                            {0.7f, {0.80f, 0.45f, 0.25f}},
                            {1.0f, {0.28f, 0.07f, 0.06f}}}),
                 -3.0f, 3.0f};
  look.is_cut = true;
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  const RawShaping::Range range = raw ? raw->range : RawShaping::Range::raw;
  if (range != RawShaping::Range::raw) look.most = 1.0f;
  if (range == RawShaping::Range::signed_values) look.least = -1.0f;
  if (range == RawShaping::Range::unit) look.least = 0.0f;
  return look;
}

// A body of a density has the colours of the last grid, white where that is 0, or is grey if there is one
// only.
Image picture_of_body(const Volume& volume, const FloatPtr& density, const PreviewOptions& options,
                      Progress* progress) {
  if (volume.grids.size() == 1) {
    return render_solid(*density, density, {parse_color_ramp("0:#b5ada0,1:#b5ada0")}, options, progress);
  }
  SolidLook look{parse_color_ramp("0:#f3f0e9,0.3:#d9d5cd,0.55:#9c9a98,0.8:#555a63,1:#20242c")};
  look.is_polished = true;
  const auto colours = openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grids.back().grid);
  return render_solid(colours ? *colours : *density, density, look, options, progress);
}

}  // namespace

Image picture_of(const Volume& volume, const VolumeRecipe& recipe, openvdb::FloatGrid::ConstPtr frame,
                 Progress* progress) {
  const VolumeRecipe first = recipes_of_grids(recipe).front();
  if (first.output.front() != Output::value) return render_slice(volume, first);
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grids.front().grid);
  PreviewOptions options;
  options.up = recipe.up;
  options.frame = std::move(frame);
  if (density->getGridClass() == openvdb::GRID_LEVEL_SET) return render_surface(*density, options, progress);
  switch (look_of(volume, recipe, *density)) {
    case PreviewLook::fire:
      if (const FloatPtr temperature = grid_named(volume, "temperature")) {
        return render_fire({density, temperature, grid_named(volume, "flame")}, options, progress);
      }
      break;
    case PreviewLook::smoke:
      return render_smoke(*density, options, progress);
    case PreviewLook::nebula:
      return render_nebula(*density, options, progress);
    case PreviewLook::solid:
      if (density->getGridClass() == openvdb::GRID_FOG_VOLUME) {
        return picture_of_body(volume, density, options, progress);
      }
      return render_solid(*density, nullptr, noise_look(first), options, progress);
    case PreviewLook::automatic:
    case PreviewLook::cloud:
      break;
  }
  return render_preview(*density, options, progress);
}

Image picture_of_part(const Volume& volume, const VolumeRecipe& recipe, const VolumePlan& plan,
                      openvdb::FloatGrid::ConstPtr frame, Progress* progress) {
  if (!frame) frame = full_grid(plan);
  const VolumeRecipe first = recipes_of_grids(recipe).front();
  if (std::holds_alternative<RawShaping>(first.shaping)) return picture_of(volume, recipe, frame, progress);
  Volume shown = volume;
  MeasuredGrid& measured = shown.grids.front();
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(measured.grid)->deepCopy();
  scale_density(first, *density, measured.moments.front());
  density->setGridClass(openvdb::GRID_FOG_VOLUME);
  measured.grid = density;
  return picture_of(shown, recipe, frame, progress);
}

}  // namespace solidnoise
