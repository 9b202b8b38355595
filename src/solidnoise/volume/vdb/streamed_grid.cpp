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

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

// A node of a tree of `Value`s that has the children of the mask's node, no active tile, and values of 0.
template <typename Value, typename MaskNode>
void write_node(std::ostream& stream, const MaskNode& node, bool half) {
  if constexpr (MaskNode::LEVEL == 0) {
    node.valueMask().save(stream);
  } else {
    node.getChildMask().save(stream);
    node.getValueMask().save(stream);
    const std::vector<Value> values(MaskNode::NUM_VALUES, openvdb::zeroVal<Value>());
    openvdb::io::writeCompressedValues(stream, const_cast<Value*>(values.data()), MaskNode::NUM_VALUES,
                                       node.getValueMask(), node.getChildMask(), half);
    for (auto child = node.cbeginChildOn(); child; ++child) write_node<Value>(stream, *child, half);
  }
}

template <typename Grid>
class TypedStreamedGrid final : public Grid, public StreamedGrid {
 public:
  TypedStreamedGrid(openvdb::MaskTree::ConstPtr mask, FillSlab fill, std::size_t slab_bytes)
      : mask_(std::move(mask)), fill_(std::move(fill)), slab_bytes_(slab_bytes) {}
  TypedStreamedGrid(const TypedStreamedGrid& other)
      : Grid(other), mask_(other.mask_), fill_(other.fill_), slab_bytes_(other.slab_bytes_) {}

  bool empty() const override { return mask_->empty(); }
  openvdb::Index64 activeVoxelCount() const override { return mask_->activeVoxelCount(); }
  openvdb::CoordBBox evalActiveVoxelBoundingBox() const override {
    openvdb::CoordBBox box;
    mask_->evalActiveVoxelBoundingBox(box);
    return box;
  }
  openvdb::Coord evalActiveVoxelDim() const override { return evalActiveVoxelBoundingBox().dim(); }

  // Of the grid with all values, as tools::memUsage() counts it.
  openvdb::Index64 memUsage() const override {
    using Root = typename Tree::RootNodeType;
    using Upper = typename Root::ChildNodeType;
    using Lower = typename Upper::ChildNodeType;
    const std::vector<openvdb::Index32> nodes = mask_->nodeCount();  // from the leaves up
    return sizeof(Tree) + sizeof(Root) + nodes[2] * bytes_of_node<Upper>() +
           nodes[1] * bytes_of_node<Lower>() + nodes[0] * (sizeof(Leaf) + Leaf::SIZE * sizeof(Value));
  }

  // With metadata of its own.
  using Grid::copyGrid;
  openvdb::GridBase::ConstPtr copyGrid() const override { return std::make_shared<TypedStreamedGrid>(*this); }

  void writeTopology(std::ostream& stream) const override {
    const bool half = this->saveFloatAsHalf();
    constexpr std::int32_t kBuffersOfLeaf = 1;
    const auto& root = mask_->root();
    write_number(stream, kBuffersOfLeaf);
    write_number(stream, this->background());
    openvdb::io::setGridBackgroundValuePtr(stream, &this->background());
    write_number(stream, openvdb::Index{0});  // tiles
    write_number(stream, openvdb::Index{root.childCount()});
    for (auto child = root.cbeginChildOn(); child; ++child) {
      stream.write(reinterpret_cast<const char*>(child.getCoord().asPointer()), 3 * sizeof(openvdb::Int32));
      write_node<Value>(stream, *child, half);
    }
  }

  void writeBuffers(std::ostream& stream) const override {
    if (checksum_) throw std::logic_error("a streamed grid is written once");
    GridChecksum<Grid> sum(*this, mask_->leafCount());
    constexpr int kComponents = sizeof(Value) / sizeof(float);
    visit_slabs(*mask_, kComponents, slab_bytes_, [&](const openvdb::MaskTree::Ptr& slab) {
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

  template <typename Node>
  static std::uint64_t bytes_of_node() {
    return Node::NUM_VALUES * sizeof(typename Node::UnionType) + 2 * sizeof(typename Node::NodeMaskType) +
           sizeof(openvdb::Coord);
  }

  const openvdb::MaskTree::ConstPtr mask_;
  const FillSlab fill_;
  const std::size_t slab_bytes_;
  mutable std::optional<std::uint64_t> checksum_;  // writing a grid does not change it, says OpenVDB
};

}  // namespace

void visit_slabs(const openvdb::MaskTree& mask, int components, std::size_t bytes, const VisitSlab& visit) {
  const std::size_t most = bytes / (MaskLeaf::SIZE * sizeof(float) * static_cast<std::size_t>(components));
  std::shared_ptr<openvdb::MaskTree> slab;
  std::size_t leaves = 0;
  const auto add_node = [&](const auto& node) {
    if (slab && leaves + node.leafCount() > most) visit(std::exchange(slab, nullptr));
    if (!slab) {
      slab = std::make_shared<openvdb::MaskTree>(false);
      leaves = 0;
    }
    for (auto leaf = node.cbeginChildOn(); leaf; ++leaf) slab->addLeaf(new MaskLeaf(*leaf));
    leaves += node.leafCount();
  };
  for (auto upper = mask.root().cbeginChildOn(); upper; ++upper) {
    for (auto lower = upper->cbeginChildOn(); lower; ++lower) add_node(*lower);
  }
  if (slab) visit(slab);
}

openvdb::GridBase::Ptr make_streamed_grid(int components, openvdb::MaskTree::ConstPtr mask, FillSlab fill,
                                          std::size_t slab_bytes) {
  if (components == 3) {
    return std::make_shared<TypedStreamedGrid<openvdb::Vec3SGrid>>(std::move(mask), std::move(fill),
                                                                   slab_bytes);
  }
  return std::make_shared<TypedStreamedGrid<openvdb::FloatGrid>>(std::move(mask), std::move(fill),
                                                                 slab_bytes);
}

}  // namespace solidnoise
