#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/run_tool.h"
#include "noisefit/commands.h"
#include "noisefit/fit_flags.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/core/named_error.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kVolumeDescription[] =
    "noisefit volume turns a box of a grid of floats into a noise in 3D that looks like it, waves of all "
    "directions\n"
    "in their own strength.";

constexpr int kLongestSide = 64;  // voxels, without --box
constexpr int kLargestSide = 256;

struct VolumeCommand : FitOptions {
  std::string in;
  std::string grid;
  std::optional<Box<3>> box;
};

void declare_flags(FlagSet& flags, VolumeCommand& command) {
  flags.argument("IN.vdb", "The volume", command.in);
  declare_output_flags(flags, command, "A sheet: slices of the volume, its Gaussian version and the noise");
  flags.keep("--grid", "NAME", "The grid (default: the first of floats)", command.grid);
  flags.add(
      {"--box", FlagForm<Box<3>>::names({}),
       "The part to learn from, world units (default: the middle, 64 voxels at most)",
       [&](const std::vector<std::string>& texts) { command.box = FlagForm<Box<3>>::read("--box", texts); }});
  declare_patch_flag(flags, command, "VOXELS");
  declare_fields(flags, command.fit.spectrum);
}

// The middle of a box, its sides cut to a length.
openvdb::CoordBBox middle_of(const openvdb::CoordBBox& box) {
  openvdb::CoordBBox middle = box;
  for (int axis = 0; axis < 3; ++axis) {
    const int side = std::min(box.dim()[axis], kLongestSide);
    middle.min()[axis] = box.min()[axis] + (box.dim()[axis] - side) / 2;
    middle.max()[axis] = middle.min()[axis] + side - 1;
  }
  return middle;
}

struct VolumeBox {
  Exemplar<3> exemplar;
  double grid_bytes = 0.0;  // of all of the grid
};

// Inactive voxels have their values too: in a fog volume, 0.
VolumeBox read_box(const VolumeCommand& command) {
  const openvdb::FloatGrid::Ptr grid = read_float_grid(command.in, command.grid);
  const GridFrame frame(grid->transform());
  const openvdb::CoordBBox active = grid->evalActiveVoxelBoundingBox();
  if (!command.box && active.empty()) {
    throw std::runtime_error(fmt::format("{}: the grid has no active voxels", command.in));
  }
  const openvdb::CoordBBox box = command.box ? frame.voxels_in(*command.box) : middle_of(active);
  const openvdb::Coord sides = box.empty() ? openvdb::Coord(0) : box.dim();
  const int longest = std::max({sides.x(), sides.y(), sides.z()});
  if (longest > kLargestSide) {
    throw UsageError(fmt::format("--box is {} x {} x {} voxels; it must be {} at most along an axis",
                                 sides.x(), sides.y(), sides.z(), kLargestSide));
  }
  VolumeBox result{{}, static_cast<double>(grid->memUsage())};
  Exemplar<3>& exemplar = result.exemplar;
  DenseField<3>& field =
      exemplar.channels.emplace_back(glm::ivec3(sides.x(), sides.y(), sides.z()), frame.voxel_size());
  const auto accessor = grid->getConstAccessor();
  float* value = field.values.data();
  if (!box.empty()) {
    for (auto voxel = box.begin(); voxel; ++voxel) *value++ = accessor.getValue(*voxel);
  }
  as_file_error([&] { exemplar.validate(command.in); });
  return result;
}

void require_fit_cost(const VolumeCommand& command, const std::vector<Exemplar<3>>& exemplars,
                      double grid_bytes) {
  FitSize size = fit_size(exemplars, command);
  size.held = (command.outputs.preview.empty() ? kProgramBytes : kPictureProgramBytes) + grid_bytes +
              sizeof(float) * size.read;
  require_fit_cost(command, size);
}

// Slices, from the least to the largest value of the volume's.
Image draw_sheet(const VolumeCommand& command, const Exemplar<3>& volume, const ExemplarFit<3>& fit,
                 double seconds) {
  const Exemplar<2> slice = middle_slice(volume);
  const auto [least, largest] = std::minmax_element(slice.channels[0].values.begin(),  //
                                                    slice.channels[0].values.end());
  return draw_exemplar_sheet(slice, fit.model,
                             {.title = std::filesystem::path(command.in).stem().string(),
                              .caption = describe_shortly(fit, seconds),
                              .seed = command.seed,
                              .black = *least,
                              .white = *largest});
}

}  // namespace

int run_volume(const std::vector<std::string>& arguments) {
  VolumeCommand command;
  FlagSet flags("noisefit volume", kVolumeDescription);
  declare_flags(flags, command);
  parse_fit(flags, arguments, command);
  command.fit.raw_values = true;
  command.outputs.check({command.in});

  VolumeBox box = read_box(command);
  const std::vector<Exemplar<3>> exemplars{std::move(box.exemplar)};
  require_fit_cost(command, exemplars, box.grid_bytes);
  command.outputs.pixel_size = exemplars.front().channels.front().step.x;
  catch_interrupts();
  const Clock::time_point start = Clock::now();
  TaskProgress progress(command.visibility());
  progress.begin("fitting");
  const ExemplarFit<3> fit = fit_exemplar<3>(exemplars, command.fit, &progress);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (fit.interrupted) return keep_last_solution(command.outputs, fit.model);
  command.outputs.write(fit.model, [&] { return draw_sheet(command, exemplars.front(), fit, seconds); });
  if (command.quiet) return kDone;
  std::cerr << describe(fit, seconds) << describe_scale({fit.model, command.outputs.pixel_size});
  print_warnings(warnings_of(fit.channels, command.fit.spectrum.gap_tolerance));
  return kDone;
}

}  // namespace solidnoise
