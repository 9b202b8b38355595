#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "solidnoise/core/digest.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {

// A grid that a recipe takes from a file, or from memory (grid_in_memory()): whose voxels are filled, where
// noise is added, a mask, a parameter.
struct GridFile {
  std::string file;      // .vdb
  std::string grid{};    // name in the file; empty: the first one that will do
  std::string digest{};  // file_digest() of it, where the volume exists already; empty: any file will do
  openvdb::GridBase::ConstPtr memory{};  // the grid itself; `file` is then what messages call it. Not in JSON

  // Throws std::invalid_argument where there is no file.
  void validate() const;

  friend bool operator==(const GridFile&, const GridFile&) = default;
};

constexpr auto fields_of(std::type_identity<GridFile>) {
  return list_fields(field("file", &GridFile::file, "A .vdb"),
                     field("grid", &GridFile::grid, "Name in the file; empty: the first one that will do"),
                     field("digest", &GridFile::digest, "Of the file, where the volume exists already")
                         .written_if([](const GridFile& source) { return !source.digest.empty(); }));
}

// A grid that the program has, for a recipe. It is copied when a volume is planned, and may change after
// that. What is made names it "(memory)" in its recipe, with a digest of the values. Its voxels' indices must
// be within +-2^30.
GridFile grid_in_memory(openvdb::GridBase::ConstPtr grid);

// Parses "FILE.vdb" or "FILE.vdb:GRID", split at the last ".vdb:", the same of .nvdb, or "-" or "-:GRID", the
// standard input; nothing if the text is none of these.
std::optional<GridFile> parse_grid_file(std::string_view text);

// Puts the file's digest into `digest`, or, if there is one already, refuses a file of another:
// std::runtime_error naming the path. `flag` ("--shape") is what the message advises to give.
void note_digest(const std::string& file, const std::string& flag, std::string& digest);

// Reads the grid and notes the file's digest, as note_digest. A grid of another type, or any if `name` is
// empty and none of the type is there, is refused. Throws std::runtime_error naming the path, and, if there
// is no such grid, listing those that exist; Cancelled.
openvdb::GridBase::Ptr read_grid(GridFile& source, const std::string& flag, Progress* progress = nullptr);
openvdb::FloatGrid::Ptr read_float_grid(GridFile& source, const std::string& flag,
                                        Progress* progress = nullptr);
openvdb::GridBase::Ptr read_vector_grid(GridFile& source, const std::string& flag,
                                        Progress* progress = nullptr);  // vec3s or vec3d
// All of the file's, of which the grid of floats that is meant has the index `target`.
VdbFile read_grids_around(GridFile& source, const std::string& flag, std::size_t& target,
                          Progress* progress = nullptr);

}  // namespace solidnoise
