#include "vdbnoise/volume_output.h"

#include <cmath>
#include <cstddef>
#include <iostream>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "common/usage_error.h"
#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/preview/slice_preview.h"
#include "solidnoise/volume/preview/surface_preview.h"

namespace solidnoise {
namespace {

void print_statistics(const MeasuredGrid& measured, const std::string& where) {
  const openvdb::Vec3d size = measured.grid->voxelSize();
  const openvdb::Coord dim = measured.grid->evalActiveVoxelDim();
  std::cerr << fmt::format("{}: grid {}, {} active voxels in {} x {} x {}, voxel size {:.6g}\n", where,
                           measured.grid->getName(), measured.moments.front().count(), dim.x(), dim.y(),
                           dim.z(), size.x());
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
  if (!out.empty() && out != "-" && !out.ends_with(".vdb")) {
    throw UsageError(fmt::format("--out is {}; it must end in .vdb, or be - for the standard output", out));
  }
  if (!preview.empty() && !preview.ends_with(".png")) {
    throw UsageError(fmt::format("--preview is {}; it must end in .png", preview));
  }
  if (out == "-" && isatty(STDOUT_FILENO) != 0) {
    throw UsageError("--out is -, and the standard output is a terminal; send it to a file or a program");
  }
}

void write_volume(const std::string& path, const Volume& volume, const VdbWriteOptions& options) {
  openvdb::GridCPtrVec grids;
  if (!volume.file) {
    for (const MeasuredGrid& measured : volume.grids) grids.push_back(measured.grid);
    write_vdb(path, grids, options);
    return;
  }
  // What the file said of itself stays, its maker included.
  VdbWriteOptions kept = options;
  kept.metadata = volume.file->metadata;
  if (kept.metadata["creator"]) kept.creator.clear();
  grids.assign(volume.file->grids.begin(), volume.file->grids.end());
  write_vdb(path, grids, kept);
}

Image picture_of(const Volume& volume, const VolumeRecipe& recipe, openvdb::FloatGrid::ConstPtr frame,
                 Progress* progress) {
  if (recipe.output.front() != Output::value) return render_slice(volume, recipe);
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grids.front().grid);
  PreviewOptions options;
  options.up = recipe.up;
  options.frame = std::move(frame);
  const bool is_surface = density->getGridClass() == openvdb::GRID_LEVEL_SET;
  return is_surface ? render_surface(*density, options, progress)
                    : render_preview(*density, options, progress);
}

void print_statistics(const Volume& volume, const std::string& where) {
  for (const MeasuredGrid& measured : volume.grids) print_statistics(measured, where);
}

}  // namespace solidnoise
