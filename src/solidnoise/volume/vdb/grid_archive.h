#pragma once

#include <cstdint>
#include <functional>
#include <ostream>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The grid in a form for writing: OpenVDB compresses the values of one leaf after the other, which takes
// longer than making noise; this one compresses many leaves at once (write_leaves()). Shares the tree.
// Streamed grids, which do so themselves, and grids of other types than float and vec3s are returned as they
// are.
openvdb::GridBase::ConstPtr parallel_grid(const openvdb::GridBase::ConstPtr& grid);

// Writes what OpenVDB's own archives do, with three differences: files are the same, byte by byte, where
// their contents are (OpenVDB's have a random UUID in their header). Its File writes grid offsets, which let
// a reader take one grid or the metadata alone, but does not notice a full disk; its Stream writes to a
// stream of the caller's, but no offsets: this does both. And it compresses all values once. OpenVDB
// compresses them twice before version 13.2, the first time for the sizes alone (`file_delayed_load` in the
// metadata), from which a reader that loads leaves when they are asked for knows where they are; without it
// such a reader looks the sizes up in the file. Since 13.2 there is no such loading.
class GridArchive final : public openvdb::io::Archive {
 public:
  enum class Offsets { write, none };

  // What is written. `identity` gives what becomes the file's UUID, in place of a random number; it is asked
  // when all is written, or, where the stream cannot seek, before.
  struct Contents {
    openvdb::GridCPtrVec grids;
    openvdb::MetaMap metadata;
    std::function<std::uint64_t()> identity;
  };

  // With Offsets::write the stream is to be able to seek, and is at its beginning; streamed grids need it.
  // Grids that share a tree share it in the file. Equal contents make equal bytes.
  void write_grids(std::ostream& stream, Offsets offsets, const Contents& contents) const;

 private:
  using Descriptor = openvdb::io::GridDescriptor;

  openvdb::MetaMap metadata_of(std::ostream& stream, const openvdb::GridBase& grid) const;
  void write_grid(std::ostream& stream, Offsets offsets, const openvdb::GridBase& grid,
                  Descriptor& descriptor) const;
};

// As files have numbers: its bytes as they are in memory.
template <typename Number>
void write_number(std::ostream& stream, const Number& number) {
  stream.write(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace solidnoise
