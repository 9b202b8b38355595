#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Bytes of values that are in memory at once of a grid that is made as it is written: enough for all
// processors to be busy with.
inline constexpr std::size_t kSlabBytes = std::size_t{256} << 20;

// Calls `visit(slab)` for runs of a mask's leaves, in tree order, the order in which files have their values.
// Grids with as many components have about `bytes` of values in each. Slabs end where nodes of 128^3 voxels
// do.
using VisitSlab = std::function<void(const openvdb::MaskTree::Ptr& slab)>;
void visit_slabs(const openvdb::MaskTree& mask, int components, std::size_t bytes, const VisitSlab& visit);

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

// Of floats, or of vectors if `components` is 3. The mask has leaves only.
openvdb::GridBase::Ptr make_streamed_grid(int components, openvdb::MaskTree::ConstPtr mask, FillSlab fill,
                                          std::size_t slab_bytes = kSlabBytes);

}  // namespace solidnoise
