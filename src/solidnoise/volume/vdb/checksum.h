#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A hash of what is added, in its order.
class Hash {
 public:
  void add(std::uint64_t bits);
  void add(const openvdb::Coord& voxel);
  void add_bytes(const void* bytes, std::size_t size);
  std::uint64_t bits() const { return bits_; }

 private:
  std::uint64_t bits_ = 0;
};

// The checksum of a grid (grid_values.h) whose leaves are not there all at once.
template <typename Grid>
class GridChecksum {
 public:
  using Leaf = typename Grid::TreeType::LeafNodeType;

  // `grid` has the transform and counts of the whole.
  GridChecksum(const openvdb::GridBase& grid, std::uint64_t leaves);

  // The next leaves, in tree order.
  void add(std::span<const Leaf* const> leaves);
  // With the grid's tiles and background.
  std::uint64_t finish(const Grid& grid) const;

 private:
  Hash hash_;
};

}  // namespace solidnoise
