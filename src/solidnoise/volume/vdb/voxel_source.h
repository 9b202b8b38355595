#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// The voxels that a grid is to have, which need not be in memory all at once: node after node of 128^3 voxels
// in tree order, the order in which files have them. Each node has a leaf at least, and leaves only.
class VoxelSource {
 public:
  struct Node {
    openvdb::Coord origin;
    openvdb::Index64 leaves = 0;
  };

  virtual ~VoxelSource() = default;

  virtual const std::vector<Node>& nodes() const = 0;
  virtual openvdb::Index64 active_voxels() const = 0;
  virtual openvdb::CoordBBox active_bounds() const = 0;  // empty if there are none
  // The leaves of nodes [first, end).
  virtual openvdb::MaskTree::Ptr voxels(std::size_t first, std::size_t end) const = 0;

  openvdb::Index64 leaf_count() const;
};

// Those of a mask that has leaves only.
class MaskVoxels final : public VoxelSource {
 public:
  explicit MaskVoxels(openvdb::MaskTree::ConstPtr mask);

  const std::vector<Node>& nodes() const override { return nodes_; }
  openvdb::Index64 active_voxels() const override { return mask_->activeVoxelCount(); }
  openvdb::CoordBBox active_bounds() const override;
  openvdb::MaskTree::Ptr voxels(std::size_t first, std::size_t end) const override;

 private:
  openvdb::MaskTree::ConstPtr mask_;
  std::vector<Node> nodes_;
};

// Calls `visit(slab)` for runs of leaves, in tree order. Grids with as many components have about `bytes` of
// values in each. Slabs end where nodes do.
using VisitSlab = std::function<void(const openvdb::MaskTree::Ptr& slab)>;
void visit_slabs(const VoxelSource& voxels, int components, std::size_t bytes, const VisitSlab& visit);

}  // namespace solidnoise
