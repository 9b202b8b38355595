#include <iostream>

#include <fmt/format.h>

#include "common/flag_set.h"
#include "common/run_tool.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "vdbnoise/commands.h"

namespace solidnoise {
namespace {

// In a line of its own.
std::string in_line(const std::string& text) {
  constexpr std::size_t kMost = 1 << 16;
  return printable(text, kMost);
}

// Lines of a text, each with a margin.
void print_indented(const std::string& text, const std::string& margin) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::cout << margin << text.substr(begin, end - begin) << '\n';
    begin = end + 1;
  }
}

void print_metadata(const std::map<std::string, std::string>& metadata) {
  for (const auto& [key, value] : metadata) {
    if (key != kRecipeKey) std::cout << fmt::format("    {} = {}\n", in_line(key), in_line(value));
  }
}

void print_grid(const GridSummary& grid) {
  const std::string vectors = grid.vector_type.empty() ? "" : fmt::format(", {}", grid.vector_type);
  std::cout << fmt::format("grid {}: {}{}, {}{}\n", in_line(grid.name), grid.value_type, vectors,
                           grid.grid_class, grid.saved_as_half ? ", stored as half" : "");
  const Vec<3>& voxel = grid.voxel_size;
  std::cout << fmt::format("  voxel size {} x {} x {}\n", voxel.x, voxel.y, voxel.z);
  if (grid.active_voxels > 0) {
    const openvdb::Coord size = grid.voxel_bounds.dim();
    const openvdb::Coord& lower = grid.voxel_bounds.min();
    const openvdb::Coord& upper = grid.voxel_bounds.max();
    std::cout << fmt::format("  {} active voxels in {} x {} x {}, ({}, {}, {}) to ({}, {}, {})\n",
                             grid.active_voxels, size.x(), size.y(), size.z(), lower.x(), lower.y(),
                             lower.z(), upper.x(), upper.y(), upper.z());
  } else {
    std::cout << "  no active voxels\n";
  }
  if (!grid.metadata.empty()) std::cout << "  metadata\n";
  print_metadata(grid.metadata);
  const auto recipe = grid.metadata.find(kRecipeKey);
  if (recipe == grid.metadata.end()) return;
  std::cout << "  recipe\n";
  print_indented(recipe->second, "    ");
}

}  // namespace

int run_info(const std::vector<std::string>& arguments) {
  std::string file;
  FlagSet flags("vdbnoise info",
                "Prints the grids of an OpenVDB or NanoVDB file, and the recipes they carry.");
  flags.argument("FILE", "The .vdb or .nvdb", file);
  flags.parse(arguments);
  flags.apply();

  const VdbSummary summary = read_vdb_summary(file);
  if (!summary.metadata.empty()) std::cout << "file metadata\n";
  print_metadata(summary.metadata);
  for (const GridSummary& grid : summary.grids) print_grid(grid);
  return kDone;
}

}  // namespace solidnoise
