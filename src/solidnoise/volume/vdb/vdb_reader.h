#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include "solidnoise/volume/vdb/cancellable_file.h"
#include "solidnoise/volume/vdb/grid_source.h"
#include "solidnoise/volume/vdb/vdb_header.h"
#include "solidnoise/volume/vdb/vdb_structure.h"

namespace solidnoise {

// Reads .vdb files as OpenVDB's File does, but notices damage that it does not: reading past the end is an
// error, and so are offsets and sizes that do not fit in the file. (OpenVDB takes a file of uncompressed
// values that is cut short for a whole one, and allocates whatever size it finds.) Never loads lazily.
//
// Throws std::exception of any kind where the file is damaged.
class VdbReader final : public openvdb::io::Archive, public GridSource {
 public:
  // Where `progress`, which may be null, asks to stop, reading throws Cancelled.
  explicit VdbReader(const std::filesystem::path& path, Progress* progress = nullptr);

  const openvdb::MetaMap& metadata() const override { return metadata_; }
  std::size_t grid_count() const override { return entries_.size(); }
  std::string grid_name(std::size_t index) const override;
  openvdb::GridBase::Ptr read_header(std::size_t index) override;
  openvdb::GridBase::Ptr read_grid(std::size_t index) override;
  openvdb::GridPtrVec read_grids() override;

  // Whether it is a file that tells where its grids are; what went through a pipe is not, and all of it is
  // read at once. For the two below it has to be.
  bool has_offsets() const { return inputHasGridOffsets(); }
  // The nodes of 128^3 voxels of a grid, in tree order; checks the grid as read_grid() does.
  std::vector<VdbNode> find_nodes(std::size_t index);
  // Adds the leaves of one of them, of a grid of floats or of vec3s with a background of 0, to a tree of the
  // grid's type, with their values; or, to a mask, where they are active.
  void read_values(std::size_t index, const VdbNode& node, openvdb::FloatTree& tree);
  void read_values(std::size_t index, const VdbNode& node, openvdb::Vec3STree& tree);
  void read_voxels(std::size_t index, const VdbNode& node, openvdb::MaskTree& mask);

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
  std::vector<VdbNode> check_grid(const openvdb::io::GridDescriptor& descriptor);

  // Reads a node's topology into `lower`, one of a tree's; the stream then can read its values.
  template <typename Lower>
  void read_topology(std::size_t index, const VdbNode& node, Lower& lower);
  template <typename Tree>
  void read_leaves(std::size_t index, const VdbNode& node, Tree& tree);
  template <typename Tree>
  void read_masks(std::size_t index, const VdbNode& node, openvdb::MaskTree& mask);

  std::uint32_t skim_grid_header();  // goes past it, and gives the grid's compression flags
  VdbHeaderWalk walk();

  CancellableFile file_;
  std::istream stream_{&file_};
  std::int64_t size_ = 0;
  openvdb::io::StreamMetadata::Ptr stream_metadata_;
  openvdb::MetaMap metadata_;
  std::vector<Entry> entries_;
};

}  // namespace solidnoise
