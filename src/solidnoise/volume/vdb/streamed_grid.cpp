#include "solidnoise/volume/vdb/streamed_grid.h"

#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <vector>

#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>

#include "solidnoise/volume/vdb/checksum.h"
#include "solidnoise/volume/vdb/grid_archive.h"
#include "solidnoise/volume/vdb/write_leaves.h"

namespace solidnoise {
namespace {

using UpperMask = openvdb::MaskTree::RootNodeType::ChildNodeType;

// What is its own of an inner node of `Value`s that has these children, no active tile, and values of 0.
template <typename Value, typename Mask>
void write_inner(std::ostream& stream, const Mask& children, bool half) {
  const Mask active;
  children.save(stream);
  active.save(stream);
  std::vector<Value> values(Mask::SIZE, openvdb::zeroVal<Value>());
  openvdb::io::writeCompressedValues(stream, values.data(), Mask::SIZE, active, children, half);
}

// Where the parent of a node, of 4096^3 voxels, begins.
openvdb::Coord parent_of(const VoxelSource::Node& node) {
  return node.origin & ~(static_cast<openvdb::Int32>(UpperMask::DIM) - 1);
}

template <typename Grid>
class TypedStreamedGrid final : public Grid, public StreamedGrid {
 public:
  TypedStreamedGrid(std::shared_ptr<const VoxelSource> voxels, FillSlab fill, std::size_t slab_bytes)
      : voxels_(std::move(voxels)), fill_(std::move(fill)), slab_bytes_(slab_bytes) {}
  TypedStreamedGrid(const TypedStreamedGrid& other)
      : Grid(other), voxels_(other.voxels_), fill_(other.fill_), slab_bytes_(other.slab_bytes_) {}

  bool empty() const override { return voxels_->nodes().empty(); }
  openvdb::Index64 activeVoxelCount() const override { return voxels_->active_voxels(); }
  openvdb::CoordBBox evalActiveVoxelBoundingBox() const override { return voxels_->active_bounds(); }
  openvdb::Coord evalActiveVoxelDim() const override { return evalActiveVoxelBoundingBox().dim(); }

  // Of the grid with all values, as tools::memUsage() counts it.
  openvdb::Index64 memUsage() const override {
    using Root = typename Tree::RootNodeType;
    using Upper = typename Root::ChildNodeType;
    using Lower = typename Upper::ChildNodeType;
    return sizeof(Tree) + sizeof(Root) + parents().size() * bytes_of_node<Upper>() +
           voxels_->nodes().size() * bytes_of_node<Lower>() +
           voxels_->leaf_count() * (sizeof(Leaf) + Leaf::SIZE * sizeof(Value));
  }

  // With metadata of its own.
  using Grid::copyGrid;
  openvdb::GridBase::ConstPtr copyGrid() const override { return std::make_shared<TypedStreamedGrid>(*this); }

  void writeTopology(std::ostream& stream) const override {
    const bool half = this->saveFloatAsHalf();
    const std::vector<VoxelSource::Node>& nodes = voxels_->nodes();
    constexpr std::int32_t kBuffersOfLeaf = 1;
    write_number(stream, kBuffersOfLeaf);
    write_number(stream, this->background());
    openvdb::io::setGridBackgroundValuePtr(stream, &this->background());
    const std::vector<Run> uppers = parents();
    write_number(stream, openvdb::Index{0});  // tiles
    write_number(stream, static_cast<openvdb::Index>(uppers.size()));
    for (const Run& upper : uppers) {
      const openvdb::Coord origin = parent_of(nodes[upper.first]);
      stream.write(reinterpret_cast<const char*>(origin.asPointer()), 3 * sizeof(openvdb::Int32));
      UpperMask::NodeMaskType children;
      for (std::size_t i = upper.first; i < upper.end; ++i) {
        children.setOn(UpperMask::coordToOffset(nodes[i].origin));
      }
      write_inner<Value>(stream, children, half);
      for (std::size_t i = upper.first; i < upper.end; ++i) write_lower(stream, i, half);
    }
  }

  void writeBuffers(std::ostream& stream) const override {
    if (checksum_) throw std::logic_error("a streamed grid is written once");
    GridChecksum<Grid> sum(*this, voxels_->leaf_count());
    constexpr int kComponents = sizeof(Value) / sizeof(float);
    visit_slabs(*voxels_, kComponents, slab_bytes_, [&](const openvdb::MaskTree::Ptr& slab) {
      const auto values = openvdb::gridPtrCast<Grid>(fill_(slab));
      std::vector<const Leaf*> leaves;
      values->tree().getNodes(leaves);
      if (leaves.size() != slab->leafCount()) throw std::logic_error("a slab was filled with other leaves");
      sum.add(leaves);
      write_leaves<Leaf>(stream, leaves, *this);
    });
    checksum_ = sum.finish(*this);
  }

  std::uint64_t written_checksum() const override { return checksum_.value(); }

 private:
  using Tree = typename Grid::TreeType;
  using Leaf = typename Tree::LeafNodeType;
  using Value = typename Grid::ValueType;

  // Nodes [first, end) of one parent.
  struct Run {
    std::size_t first = 0;
    std::size_t end = 0;
  };

  std::vector<Run> parents() const {
    const std::vector<VoxelSource::Node>& nodes = voxels_->nodes();
    std::vector<Run> runs;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (i == 0 || parent_of(nodes[i]) != parent_of(nodes[i - 1])) runs.push_back({i, i});
      runs.back().end = i + 1;
    }
    return runs;
  }

  void write_lower(std::ostream& stream, std::size_t node, bool half) const {
    const openvdb::MaskTree::Ptr voxels = voxels_->voxels(node, node + 1);
    const auto lower = voxels->root().cbeginChildOn()->cbeginChildOn();
    write_inner<Value>(stream, lower->getChildMask(), half);
    for (auto leaf = lower->cbeginChildOn(); leaf; ++leaf) leaf->valueMask().save(stream);
  }

  template <typename Node>
  static std::uint64_t bytes_of_node() {
    return Node::NUM_VALUES * sizeof(typename Node::UnionType) + 2 * sizeof(typename Node::NodeMaskType) +
           sizeof(openvdb::Coord);
  }

  const std::shared_ptr<const VoxelSource> voxels_;
  const FillSlab fill_;
  const std::size_t slab_bytes_;
  mutable std::optional<std::uint64_t> checksum_;  // writing a grid does not change it, says OpenVDB
};

}  // namespace

openvdb::GridBase::Ptr make_streamed_grid(int components, std::shared_ptr<const VoxelSource> voxels,
                                          FillSlab fill, std::size_t slab_bytes) {
  if (components == 3) {
    return std::make_shared<TypedStreamedGrid<openvdb::Vec3SGrid>>(std::move(voxels), std::move(fill),
                                                                   slab_bytes);
  }
  return std::make_shared<TypedStreamedGrid<openvdb::FloatGrid>>(std::move(voxels), std::move(fill),
                                                                 slab_bytes);
}

}  // namespace solidnoise
