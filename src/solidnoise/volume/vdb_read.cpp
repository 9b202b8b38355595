#include "solidnoise/volume/vdb_read.h"

#include <cerrno>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace solidnoise {
namespace {

void require_readable(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(fmt::format("{}: is a folder, not a .vdb", path.string()));
  }
  const std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read: {}", path.string(), std::generic_category().message(errno)));
  }
}

// Opens a .vdb and gives it to `use`, whose result it returns; what OpenVDB throws becomes an error that
// names the path.
template <typename Use>
auto with_open_file(const std::filesystem::path& path, const Use& use) {
  require_readable(path);
  openvdb::initialize();
  try {
    openvdb::io::File file(path.string());
    file.open(/*delayLoad=*/false);
    return use(file);
  } catch (const openvdb::Exception& error) {
    throw std::runtime_error(fmt::format("{}: is not a .vdb, or damaged: {}", path.string(), error.what()));
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: is damaged, or too large for the memory", path.string()));
  } catch (const std::length_error&) {
    throw std::runtime_error(fmt::format("{}: is damaged", path.string()));
  }
}

// The grids' metadata, at least one.
openvdb::GridPtrVec read_headers(openvdb::io::File& file) {
  openvdb::GridPtrVec grids = *file.readAllGridMetadata();
  if (grids.empty()) throw std::runtime_error(fmt::format("{}: holds no grids", file.filename()));
  for (const openvdb::GridBase::Ptr& grid : grids) {
    if (grid == nullptr) throw std::runtime_error(fmt::format("{}: is damaged", file.filename()));
  }
  return grids;
}

std::map<std::string, std::string> to_text(const openvdb::MetaMap& metadata) {
  std::map<std::string, std::string> result;
  for (auto entry = metadata.beginMeta(); entry != metadata.endMeta(); ++entry) {
    if (entry->second != nullptr) result[entry->first] = entry->second->str();
  }
  return result;
}

// Active voxels and their box: as the file's statistics say, or, if it has none, by reading the grid.
void summarize_voxels(openvdb::io::File& file, const openvdb::GridBase& grid, GridSummary& summary) {
  const auto count = grid.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
  const auto lower = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MIN);
  const auto upper = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MAX);
  if (count != nullptr && lower != nullptr && upper != nullptr && count->value() >= 0) {
    summary.active_voxels = static_cast<std::uint64_t>(count->value());
    if (summary.active_voxels > 0) {
      summary.voxel_bounds = {openvdb::Coord(lower->value()), openvdb::Coord(upper->value())};
    }
    return;
  }
  const openvdb::GridBase::Ptr full = file.readGrid(grid.getName());
  summary.active_voxels = full->activeVoxelCount();
  summary.voxel_bounds = full->evalActiveVoxelBoundingBox();
}

GridSummary summarize(openvdb::io::File& file, const openvdb::GridBase& grid) {
  GridSummary summary;
  summary.name = grid.getName();
  summary.value_type = grid.valueType();
  summary.grid_class = openvdb::GridBase::gridClassToString(grid.getGridClass());
  summary.saved_as_half = grid.saveFloatAsHalf();
  const openvdb::Vec3d voxel = grid.transform().voxelSize();
  summary.voxel_size = {voxel.x(), voxel.y(), voxel.z()};
  summary.metadata = to_text(grid);
  summarize_voxels(file, grid, summary);
  return summary;
}

std::string list_names(const openvdb::GridPtrVec& grids) {
  std::string names;
  for (const openvdb::GridBase::Ptr& grid : grids) {
    names += fmt::format("{}'{}' ({})", names.empty() ? "" : ", ", grid->getName(), grid->valueType());
  }
  return names;
}

// The first grid that has the name, or any name if it is empty, and that `suits`; its tree is not read yet.
template <typename Suits>
openvdb::GridBase::Ptr read_matching(const std::filesystem::path& path, const std::string& name,
                                     const char* kind, const Suits& suits) {
  return with_open_file(path, [&](openvdb::io::File& file) {
    const openvdb::GridPtrVec headers = read_headers(file);
    for (const openvdb::GridBase::Ptr& header : headers) {
      const bool named = name.empty() || header->getName() == name;
      if (named && suits(*header)) return file.readGrid(header->getName());
    }
    const std::string wanted = name.empty() ? std::string() : fmt::format(" '{}'", name);
    throw std::runtime_error(
        fmt::format("{}: has no {}{}; it has {}", path.string(), kind, wanted, list_names(headers)));
  });
}

}  // namespace

VdbSummary read_vdb_summary(const std::filesystem::path& path) {
  return with_open_file(path, [](openvdb::io::File& file) {
    VdbSummary summary;
    summary.metadata = to_text(*file.getMetadata());
    for (const openvdb::GridBase::Ptr& grid : read_headers(file))
      summary.grids.push_back(summarize(file, *grid));
    return summary;
  });
}

openvdb::GridBase::Ptr read_grid(const std::filesystem::path& path, const std::string& name) {
  return read_matching(path, name, "grid", [](const openvdb::GridBase&) { return true; });
}

openvdb::FloatGrid::Ptr read_float_grid(const std::filesystem::path& path, const std::string& name) {
  const openvdb::GridBase::Ptr grid =
      read_matching(path, name, "grid of floats",
                    [](const openvdb::GridBase& header) { return header.isType<openvdb::FloatGrid>(); });
  openvdb::FloatGrid::Ptr floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
  if (floats == nullptr) throw std::runtime_error(fmt::format("{}: is damaged", path.string()));
  return floats;
}

}  // namespace solidnoise
