#include "solidnoise/volume/vdb/vdb_read.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <ios>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/volume/vdb/nvdb_reader.h"
#include "solidnoise/volume/vdb/vdb_reader.h"

namespace solidnoise {
namespace {

void require_readable(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(fmt::format("{}: is a folder, not a .vdb", path.string()));
  }
  if (std::filesystem::is_fifo(path, error)) {
    throw std::runtime_error(fmt::format(
        "{}: is a pipe, which is read but once; give - and send it to the standard input", path.string()));
  }
  const std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read: {}", path.string(), std::generic_category().message(errno)));
  }
}

constexpr std::size_t kLongestError = 400;  // bytes of an error of OpenVDB in ours

// Errors of OpenVDB begin with the name of their class.
std::string_view without_class(std::string_view error) {
  const std::size_t colon = error.find("Error: ");
  const bool is_class = colon != std::string_view::npos && error.find(' ') > colon;
  return is_class ? error.substr(colon + 7) : error;
}

const char* kind_of(const std::filesystem::path& path) {
  return extension_of(path) == ".nvdb" ? ".nvdb" : ".vdb";
}

// Runs `read`; what it throws becomes an error that names the path.
template <typename Read>
auto guarded(const std::filesystem::path& path, const Read& read) {
  try {
    return read();
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: is damaged, or too large for the memory", path.string()));
  } catch (const std::ios_base::failure&) {
    throw std::runtime_error(
        fmt::format("{}: is not a {}, or damaged: it ends too early", path.string(), kind_of(path)));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: is not a {}, or damaged: {}", path.string(), kind_of(path),
                                         printable(without_class(error.what()), kLongestError)));
  }
}

// The voxels that are read: indices beyond would overflow where sizes of boxes are taken.
constexpr std::int32_t kFarthestVoxel = (1 << 30) - 1;

void require_near(const openvdb::CoordBBox& voxels) {
  for (int axis = 0; axis < 3; ++axis) {
    if (voxels.min()[axis] >= -kFarthestVoxel && voxels.max()[axis] <= kFarthestVoxel) continue;
    throw std::runtime_error(fmt::format("it has voxels of index {} to {}, beyond +-{}", voxels.min()[axis],
                                         voxels.max()[axis], kFarthestVoxel));
  }
}

// Whose transform can be inverted, too; OpenVDB throws where it cannot.
openvdb::GridBase::Ptr require_near(openvdb::GridBase::Ptr grid) {
  const auto map = grid->transform().baseMap();
  if (map->isLinear()) map->getAffineMap();
  if (!grid->empty()) require_near(grid->evalActiveVoxelBoundingBox());
  return grid;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// What comes from the standard input, in a file without a name that goes with the process: a .vdb is not read
// from its beginning to its end. It may be read several times.
std::filesystem::path standard_input() {
  static std::unique_ptr<std::FILE, CloseFile> file;
  if (!file) {
    file.reset(std::tmpfile());
    std::vector<char> bytes(std::size_t{1} << 20);
    while (file) {
      const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), stdin);
      if (count == 0) break;
      if (std::fwrite(bytes.data(), 1, count, file.get()) != count) file.reset();
    }
    if (!file || std::fflush(file.get()) != 0) {
      throw std::runtime_error("-: the standard input cannot be kept in a file: " +
                               std::generic_category().message(errno));
    }
  }
  return fmt::format("/proc/self/fd/{}", fileno(file.get()));
}

// Opens a .vdb, or a .nvdb, that has grids.
std::unique_ptr<GridSource> open_vdb(const std::filesystem::path& path, Progress* progress = nullptr) {
  const std::filesystem::path file = path == "-" ? standard_input() : path;
  require_readable(file);
  auto reader = guarded(path, [&]() -> std::unique_ptr<GridSource> {
    if (extension_of(path) == ".nvdb") return std::make_unique<NvdbReader>(file, progress);
    return std::make_unique<VdbReader>(file, progress);
  });
  if (reader->grid_count() == 0) throw std::runtime_error(fmt::format("{}: holds no grids", path.string()));
  return reader;
}

std::map<std::string, std::string> to_text(const openvdb::MetaMap& metadata) {
  std::map<std::string, std::string> result;
  for (auto entry = metadata.beginMeta(); entry != metadata.endMeta(); ++entry) {
    if (entry->second != nullptr) result[entry->first] = entry->second->str();
  }
  return result;
}

// Active voxels and their box: as the file's statistics say, or, if it has none, by reading the grid.
void summarize_voxels(GridSource& reader, std::size_t index, const openvdb::GridBase& header,
                      GridSummary& summary) {
  const auto count = header.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
  const auto lower = header.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MIN);
  const auto upper = header.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MAX);
  if (count != nullptr && lower != nullptr && upper != nullptr && count->value() >= 0) {
    summary.active_voxels = static_cast<std::uint64_t>(count->value());
    if (summary.active_voxels > 0) {
      summary.voxel_bounds = {openvdb::Coord(lower->value()), openvdb::Coord(upper->value())};
      require_near(summary.voxel_bounds);
    }
    return;
  }
  const openvdb::GridBase::Ptr full = require_near(reader.read_grid(index));
  summary.active_voxels = full->activeVoxelCount();
  summary.voxel_bounds = full->evalActiveVoxelBoundingBox();
}

GridSummary summarize(GridSource& reader, std::size_t index) {
  const openvdb::GridBase::Ptr grid = reader.read_header(index);
  GridSummary summary;
  summary.name = reader.grid_name(index);
  summary.value_type = grid->valueType();
  summary.grid_class = openvdb::GridBase::gridClassToString(grid->getGridClass());
  if (summary.value_type.starts_with("vec")) {
    summary.vector_type = openvdb::GridBase::vecTypeToString(grid->getVectorType());
  }
  summary.saved_as_half = grid->saveFloatAsHalf();
  const openvdb::Vec3d voxel = grid->transform().voxelSize();
  summary.voxel_size = {voxel.x(), voxel.y(), voxel.z()};
  summary.metadata = to_text(*grid);
  summarize_voxels(reader, index, *grid, summary);
  return summary;
}

// The names and types of grids, for a message.
std::string listed(const std::string& name, const openvdb::GridBase& grid) {
  return fmt::format("'{}' ({})", printable(name), grid.valueType());
}

[[noreturn]] void refuse_none(const std::filesystem::path& path, const char* kind, const std::string& name,
                              const std::vector<std::string>& others) {
  const std::string wanted = name.empty() ? std::string() : fmt::format(" '{}'", name);
  throw std::runtime_error(
      fmt::format("{}: has no {}{}; it has {}", path.string(), kind, wanted, fmt::join(others, ", ")));
}

constexpr char kGridOfFloats[] = "grid of floats";

// Reads the first grid that has the name, or any name if it is empty, and whose header `suits`. `kind` says
// in messages what was looked for.
template <typename Suits>
openvdb::GridBase::Ptr read_matching(const std::filesystem::path& path, const std::string& name,
                                     const char* kind, const Suits& suits, Progress* progress) {
  const std::unique_ptr<GridSource> reader = open_vdb(path, progress);
  std::vector<std::string> others;
  for (std::size_t i = 0; i < reader->grid_count(); ++i) {
    const openvdb::GridBase::Ptr header = guarded(path, [&] { return reader->read_header(i); });
    const bool named = name.empty() || reader->grid_name(i) == name;
    if (named && suits(*header)) return guarded(path, [&] { return require_near(reader->read_grid(i)); });
    others.push_back(listed(reader->grid_name(i), *header));
  }
  refuse_none(path, kind, name, others);
}

}  // namespace

bool has_floats(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::FloatGrid>();
}

bool has_vectors(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::Vec3SGrid>() || grid.isType<openvdb::Vec3DGrid>();
}

VdbSummary read_vdb_summary(const std::filesystem::path& path) {
  const std::unique_ptr<GridSource> reader = open_vdb(path);
  return guarded(path, [&] {
    VdbSummary summary;
    summary.metadata = to_text(reader->metadata());
    for (std::size_t i = 0; i < reader->grid_count(); ++i) summary.grids.push_back(summarize(*reader, i));
    return summary;
  });
}

double memory_of(const GridSummary& grid) {
  const auto noted = grid.metadata.find(openvdb::GridBase::META_FILE_MEM_BYTES);
  std::int64_t bytes = 0;
  if (noted != grid.metadata.end()) {
    const std::string& text = noted->second;
    std::from_chars(text.data(), text.data() + text.size(), bytes);
  }
  return std::max(static_cast<double>(bytes), sizeof(float) * static_cast<double>(grid.active_voxels));
}

openvdb::GridBase::Ptr read_grid(const std::filesystem::path& path, const std::string& name,
                                 Progress* progress) {
  return read_matching(
      path, name, "grid", [](const openvdb::GridBase&) { return true; }, progress);
}

openvdb::FloatGrid::Ptr read_float_grid(const std::filesystem::path& path, const std::string& name,
                                        Progress* progress) {
  return openvdb::gridPtrCast<openvdb::FloatGrid>(
      read_matching(path, name, kGridOfFloats, has_floats, progress));
}

openvdb::GridBase::Ptr read_vector_grid(const std::filesystem::path& path, const std::string& name,
                                        Progress* progress) {
  return read_matching(path, name, "grid of vectors", has_vectors, progress);
}

openvdb::GridBase::Ptr read_float_or_vector_grid(const std::filesystem::path& path, const std::string& name,
                                                 Progress* progress) {
  return read_matching(
      path, name, "grid of floats or vectors",
      [](const openvdb::GridBase& grid) { return has_floats(grid) || has_vectors(grid); }, progress);
}

VdbFile read_grids(const std::filesystem::path& path, Progress* progress) {
  const std::unique_ptr<GridSource> reader = open_vdb(path, progress);
  VdbFile file = guarded(path, [&] { return VdbFile{reader->metadata(), reader->read_grids()}; });
  for (const openvdb::GridBase::Ptr& grid : file.grids) {
    guarded(path, [&] { return require_near(grid); });
    for (const char* about_the_file :
         {openvdb::GridBase::META_FILE_BBOX_MIN, openvdb::GridBase::META_FILE_BBOX_MAX,
          openvdb::GridBase::META_FILE_COMPRESSION, openvdb::GridBase::META_FILE_MEM_BYTES,
          openvdb::GridBase::META_FILE_VOXEL_COUNT, openvdb::GridBase::META_FILE_DELAYED_LOAD}) {
      grid->removeMeta(about_the_file);
    }
  }
  return file;
}

std::size_t find_float_grid(const std::filesystem::path& path, const VdbFile& file, const std::string& name) {
  std::vector<std::string> others;
  for (std::size_t i = 0; i < file.grids.size(); ++i) {
    const openvdb::GridBase& grid = *file.grids[i];
    if ((name.empty() || grid.getName() == name) && has_floats(grid)) return i;
    others.push_back(listed(grid.getName(), grid));
  }
  refuse_none(path, kGridOfFloats, name, others);
}

}  // namespace solidnoise
