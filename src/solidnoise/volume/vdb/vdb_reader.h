#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include "solidnoise/volume/vdb/grid_source.h"
#include "solidnoise/volume/vdb/vdb_header.h"

namespace solidnoise {

// Reads .vdb files as OpenVDB's File does, but notices damage that it does not: reading past the end is an
// error, and so are offsets and sizes that do not fit in the file. (OpenVDB takes a file of uncompressed
// values that is cut short for a whole one, and allocates whatever size it finds.) Never loads lazily.
//
// Throws std::exception of any kind where the file is damaged.
class VdbReader final : public openvdb::io::Archive, public GridSource {
 public:
  explicit VdbReader(const std::filesystem::path& path);

  const openvdb::MetaMap& metadata() const override { return metadata_; }
  std::size_t grid_count() const override { return entries_.size(); }
  std::string grid_name(std::size_t index) const override;
  openvdb::GridBase::Ptr read_header(std::size_t index) override;
  openvdb::GridBase::Ptr read_grid(std::size_t index) override;
  openvdb::GridPtrVec read_grids() override;

 private:
  struct Entry {
    openvdb::io::GridDescriptor descriptor;
    openvdb::GridBase::Ptr grid;  // where the file has no offsets, so that all had to be read
  };

  openvdb::GridBase::Ptr read_own(std::size_t index);  // without the tree that it shares with another one
  std::size_t parent_of(std::size_t index) const;      // the grid with which it does

  void require_known_version();
  void read_entry();
  openvdb::GridBase::Ptr read_grid_header(const openvdb::io::GridDescriptor& descriptor);
  // Each checks that what comes next has only sizes that fit in the file and its own structure, and goes back
  // to where it was.
  void check_metadata();
  void check_descriptor();
  void check_grid_header();
  void check_grid(const openvdb::io::GridDescriptor& descriptor);

  std::uint32_t skim_grid_header();  // goes past it, and gives the grid's compression flags
  VdbHeaderWalk walk();

  std::ifstream stream_;
  std::int64_t size_ = 0;
  openvdb::io::StreamMetadata::Ptr stream_metadata_;
  openvdb::MetaMap metadata_;
  std::vector<Entry> entries_;
};

}  // namespace solidnoise
