#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/volume/vdb/vdb_reader.h"
#include "solidnoise/volume/vdb/voxel_source.h"

namespace solidnoise {

// The files of parts, of which some are open at a time.
class PartReaders {
 public:
  explicit PartReaders(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  // Calls read(reader) with the reader of a file. What it throws becomes a std::runtime_error that names it.
  template <typename Read>
  auto with(std::size_t file, const Read& read) {
    try {
      return read(open(file));
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: {}", files_[file].string(), error.what()));
    }
  }

 private:
  struct Open {
    std::size_t file;
    std::unique_ptr<VdbReader> reader;
  };

  VdbReader& open(std::size_t file);

  std::vector<std::filesystem::path> files_;
  std::list<Open> open_;  // the last one used is the first
};

// One of the grids of a volume that is in parts: its voxels, of all of them, and its values, from the files,
// node by node.
class PartsGrid final : public VoxelSource {
 public:
  // The grid has the index in each of the files.
  PartsGrid(PartReaders& readers, std::size_t index) : readers_(readers), index_(index) {}

  // Adds the part in a file, whose grid this is: its nodes and what its voxels come to.
  void add_part(std::size_t file, const openvdb::GridBase& grid);
  // After the last one.
  void finish();

  const std::vector<Node>& nodes() const override { return nodes_; }
  openvdb::Index64 active_voxels() const override { return active_; }
  openvdb::CoordBBox active_bounds() const override { return bounds_; }
  openvdb::MaskTree::Ptr voxels(std::size_t first, std::size_t end) const override;

  // The grid's values in the leaves of a slab, which has nodes of these.
  template <typename Grid>
  typename Grid::Ptr values(const openvdb::MaskTree& slab) const;

 private:
  struct Piece {
    std::uint32_t file;
    VdbNode node;
  };

  // Reads all pieces of a node into a tree by read(reader, piece); throws where two have the same leaf.
  template <typename Tree, typename Read>
  void read_pieces(std::size_t node, Tree& tree, const Read& read) const;

  PartReaders& readers_;
  std::size_t index_;
  std::vector<Piece> pieces_;  // in tree order
  std::vector<Node> nodes_;
  std::vector<std::size_t> first_pieces_;  // of each node; and the number of all
  openvdb::Index64 active_ = 0;
  openvdb::CoordBBox bounds_;
};

}  // namespace solidnoise
