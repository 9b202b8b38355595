#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/vdb/voxel_source.h"

namespace solidnoise {

// Bytes of values that are in memory at once of a grid that is made as it is written: enough for all
// processors to be busy with.
inline constexpr std::size_t kSlabBytes = std::size_t{256} << 20;

// A grid whose tree has the voxels of a slab, active as they are there, and their values.
using FillSlab = std::function<openvdb::GridBase::Ptr(const openvdb::MaskTree::Ptr& slab)>;

// A grid that is larger than memory: its values are made as it is written, slab by slab, so that the file is
// the same, byte by byte, as that of a grid which has them all. It knows where its active voxels are; its
// tree is empty, with a background of 0. What writing finds out, such as statistics, may be set as metadata
// until the last slab is filled, where it takes no more room than what was there before. To be written once.
class StreamedGrid {
 public:
  virtual ~StreamedGrid() = default;

  // That of the grid which has them all (grid_values.h), once it is written.
  virtual std::uint64_t written_checksum() const = 0;
};

// Of floats, or of vectors if `components` is 3.
openvdb::GridBase::Ptr make_streamed_grid(int components, std::shared_ptr<const VoxelSource> voxels,
                                          FillSlab fill, std::size_t slab_bytes = kSlabBytes);

}  // namespace solidnoise
