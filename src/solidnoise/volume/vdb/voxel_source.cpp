#include "solidnoise/volume/vdb/voxel_source.h"

#include <utility>

namespace solidnoise {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

openvdb::Index64 VoxelSource::leaf_count() const {
  openvdb::Index64 leaves = 0;
  for (const Node& node : nodes()) leaves += node.leaves;
  return leaves;
}

MaskVoxels::MaskVoxels(openvdb::MaskTree::ConstPtr mask) : mask_(std::move(mask)) {
  for (auto upper = mask_->root().cbeginChildOn(); upper; ++upper) {
    for (auto lower = upper->cbeginChildOn(); lower; ++lower) {
      if (lower->leafCount() > 0) nodes_.push_back({lower->origin(), lower->leafCount()});
    }
  }
}

openvdb::CoordBBox MaskVoxels::active_bounds() const {
  openvdb::CoordBBox box;
  mask_->evalActiveVoxelBoundingBox(box);
  return box;
}

openvdb::MaskTree::Ptr MaskVoxels::voxels(std::size_t first, std::size_t end) const {
  using Lower = openvdb::MaskTree::RootNodeType::ChildNodeType::ChildNodeType;
  auto part = std::make_shared<openvdb::MaskTree>(false);
  for (std::size_t i = first; i < end; ++i) {
    const auto* const lower = mask_->probeConstNode<Lower>(nodes_[i].origin);
    for (auto leaf = lower->cbeginChildOn(); leaf; ++leaf) part->addLeaf(new MaskLeaf(*leaf));
  }
  return part;
}

void visit_slabs(const VoxelSource& voxels, int components, std::size_t bytes, const VisitSlab& visit) {
  const std::vector<VoxelSource::Node>& nodes = voxels.nodes();
  const std::size_t most = bytes / (MaskLeaf::SIZE * sizeof(float) * static_cast<std::size_t>(components));
  for (std::size_t first = 0; first < nodes.size();) {
    std::size_t end = first;
    std::size_t leaves = 0;
    do {
      leaves += nodes[end++].leaves;
    } while (end < nodes.size() && leaves + nodes[end].leaves <= most);
    visit(voxels.voxels(first, end));
    first = end;
  }
}

}  // namespace solidnoise
