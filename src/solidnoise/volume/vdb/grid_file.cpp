#include "solidnoise/volume/vdb/grid_file.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/core/extension.h"
#include "solidnoise/volume/vdb/grid_values.h"

namespace solidnoise {

void GridFile::validate() const {
  if (file.empty()) throw std::invalid_argument("file is empty; it must be a .vdb");
}

std::optional<GridFile> parse_grid_file(std::string_view text) {
  if (text == "-") return GridFile{"-"};
  if (text.starts_with("-:") && text.size() > 2) return GridFile{"-", std::string(text.substr(2))};
  const std::string small = lowered(text);
  for (const std::string_view kind : {".vdb", ".nvdb"}) {
    if (small.size() > kind.size() && small.ends_with(kind)) return GridFile{std::string(text)};
    const std::size_t extension = small.rfind(std::string(kind) + ':');
    if (extension == std::string_view::npos || extension == 0) continue;
    const std::size_t colon = extension + kind.size();
    if (colon + 1 == text.size()) return std::nullopt;
    return GridFile{std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
  }
  return std::nullopt;
}

void note_digest(const std::string& file, const std::string& flag, std::string& digest) {
  const std::string found = file_digest(file);
  if (!digest.empty() && digest != found) {
    throw std::runtime_error(
        fmt::format("{}: is not the file that the recipe was made with (its digest is {}, the recipe's {}); "
                    "name it as {} to use it as it is",
                    file, found, digest, flag));
  }
  digest = found;
}

namespace {

// Reads by `read` what is in a file.
template <typename Read>
auto read_noted(GridFile& source, const std::string& flag, const Read& read) {
  const auto grid = read(source.file, source.grid);
  note_digest(source.file, flag, source.digest);
  return grid;
}

openvdb::GridBase::Ptr copy_memory(GridFile& source, const char* kind, bool suits) {
  if (!suits) {
    throw std::runtime_error(fmt::format("{}: is a grid of {}; it must be one of {}", source.file,
                                         source.memory->valueType(), kind));
  }
  source.digest = fmt::format("{:016x}", checksum(*source.memory));
  return source.memory->deepCopyGrid();
}

}  // namespace

GridFile grid_in_memory(openvdb::GridBase::ConstPtr grid) {
  if (grid == nullptr) throw std::invalid_argument("the grid is null; it must be one");
  GridFile source{.file = "(memory)", .grid = grid->getName()};
  source.memory = std::move(grid);
  return source;
}

openvdb::GridBase::Ptr read_grid(GridFile& source, const std::string& flag, Progress* progress) {
  if (source.memory) return copy_memory(source, "any", true);
  return read_noted(source, flag,
                    [=](const auto& file, const auto& grid) { return read_grid(file, grid, progress); });
}

openvdb::FloatGrid::Ptr read_float_grid(GridFile& source, const std::string& flag, Progress* progress) {
  if (source.memory) {
    return openvdb::gridPtrCast<openvdb::FloatGrid>(copy_memory(source, "float", has_floats(*source.memory)));
  }
  return read_noted(source, flag, [=](const auto& file, const auto& grid) {
    return read_float_grid(file, grid, progress);
  });
}

openvdb::GridBase::Ptr read_vector_grid(GridFile& source, const std::string& flag, Progress* progress) {
  if (source.memory) {
    return copy_memory(source, "vec3s or vec3d", has_vectors(*source.memory));
  }
  return read_noted(source, flag, [=](const auto& file, const auto& grid) {
    return read_vector_grid(file, grid, progress);
  });
}

VdbFile read_grids_around(GridFile& source, const std::string& flag, std::size_t& target,
                          Progress* progress) {
  target = 0;
  if (source.memory) return {{}, {copy_memory(source, "float", has_floats(*source.memory))}};
  VdbFile file = read_grids(source.file, progress);
  target = find_float_grid(source.file, file, source.grid);
  note_digest(source.file, flag, source.digest);
  return file;
}

}  // namespace solidnoise
