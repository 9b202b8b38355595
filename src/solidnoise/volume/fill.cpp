#include "solidnoise/volume/fill.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

namespace solidnoise {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
using MaskLeaf = openvdb::MaskTree::LeafNodeType;
using LeafMask = MaskLeaf::NodeMaskType;

constexpr int kGroupLog2 = 5;  // a group is 4 x 4 x 4 leaves, 32^3 voxels

// Leaves that share a block: a run of indices in the list of grouped leaves.
struct Group {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// The topology's leaves in tree order, and the order of their indices that brings groups together.
struct GroupedLeaves {
  std::vector<const MaskLeaf*> leaves;
  std::vector<std::size_t> order;
  std::vector<Group> groups;
};

GroupedLeaves group_leaves(const openvdb::MaskTree& mask) {
  GroupedLeaves result;
  mask.getNodes(result.leaves);
  std::vector<std::pair<openvdb::Coord, std::size_t>> keys;
  keys.reserve(result.leaves.size());
  for (std::size_t i = 0; i < result.leaves.size(); ++i) {
    const openvdb::Coord& origin = result.leaves[i]->origin();
    keys.emplace_back(
        openvdb::Coord(origin.x() >> kGroupLog2, origin.y() >> kGroupLog2, origin.z() >> kGroupLog2), i);
  }
  std::sort(keys.begin(), keys.end());
  result.order.reserve(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].first != keys[i - 1].first) result.groups.push_back({i, i});
    result.groups.back().end = i + 1;
    result.order.push_back(keys[i].second);
  }
  return result;
}

class Filler {
 public:
  Filler(const Topology& topology, const Field& field, Sparsity sparsity, Progress* progress)
      : frame_(topology.frame),
        field_(field),
        sparsity_(sparsity),
        progress_(progress),
        grouped_(group_leaves(*topology.mask)),
        leaves_(grouped_.leaves.size()),
        moments_(grouped_.leaves.size()) {}

  FilledGrid run() {
    tbb::parallel_for(std::size_t{0}, grouped_.groups.size(), [&](std::size_t group) {
      throw_if_cancelled(progress_);
      fill_group(grouped_.groups[group]);
    });
    throw_if_cancelled(progress_);
    return collect();
  }

 private:
  void fill_group(const Group& group) {
    // Gather the leaves that need the field, and the box that they span.
    openvdb::CoordBBox box;
    std::vector<std::size_t> wanted;
    for (std::size_t i = group.begin; i < group.end; ++i) {
      const std::size_t leaf = grouped_.order[i];
      const openvdb::CoordBBox voxels = grouped_.leaves[leaf]->getNodeBoundingBox();
      if (field_.empty(frame_.bounds(voxels))) {
        if (sparsity_ == Sparsity::keep) store_zeros(leaf);
      } else {
        wanted.push_back(leaf);
        box.expand(voxels);
      }
    }
    // Evaluate them.
    if (!wanted.empty()) {
      const std::unique_ptr<FieldBlock> block = field_.block(frame_.bounds(box));
      for (const std::size_t leaf : wanted) {
        throw_if_cancelled(progress_);
        auto values = make_leaf(leaf);
        block->evaluate(frame_.lattice(values->getNodeBoundingBox()), {values->buffer().data(), Leaf::SIZE});
        store(leaf, std::move(values));
      }
    }
    if (progress_ != nullptr) progress_->advance(done_ += group.end - group.begin, leaves_.size());
  }

  void store_zeros(std::size_t index) {
    auto leaf = make_leaf(index);
    leaf->buffer().fill(0.0f);
    store(index, std::move(leaf));
  }

  // A leaf with its memory, inactive; its values are to be written yet.
  std::unique_ptr<Leaf> make_leaf(std::size_t index) const {
    auto leaf =
        std::make_unique<Leaf>(openvdb::PartialCreate(), grouped_.leaves[index]->origin(), 0.0f, false);
    leaf->buffer().allocate();
    return leaf;
  }

  // Activates the voxels that are to stay, sets the others to the background and keeps the leaf's moments.
  void store(std::size_t index, std::unique_ptr<Leaf> leaf) {
    float* const values = leaf->buffer().data();
    LeafMask mask = grouped_.leaves[index]->valueMask();
    if (sparsity_ == Sparsity::drop) drop_zeros(mask, values);
    if (mask.isOff()) return;
    leaf->setValueMask(mask);
    for (auto voxel = mask.beginOff(); voxel; ++voxel) values[voxel.pos()] = 0.0f;
    moments_[index] = measure(*leaf);
    leaves_[index] = std::move(leaf);
  }

  static void drop_zeros(LeafMask& mask, const float* values) {
    for (unsigned word = 0; word < LeafMask::WORD_COUNT; ++word) {
      std::uint64_t not_zero = 0;
      for (unsigned bit = 0; bit < 64; ++bit) {
        not_zero |= static_cast<std::uint64_t>(values[64 * word + bit] != 0.0f) << bit;
      }
      mask.getWord<std::uint64_t>(word) &= not_zero;
    }
  }

  FilledGrid collect() {
    FilledGrid result{openvdb::FloatGrid::create(0.0f), {}};
    result.grid->setTransform(frame_.transform());
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      if (leaves_[i] == nullptr) continue;
      result.grid->tree().addLeaf(leaves_[i].release());
      result.moments.merge(moments_[i]);
    }
    return result;
  }

  const GridFrame& frame_;
  const Field& field_;
  const Sparsity sparsity_;
  Progress* const progress_;
  const GroupedLeaves grouped_;
  std::vector<std::unique_ptr<Leaf>> leaves_;  // in tree order; null where there is none
  std::vector<Moments> moments_;
  std::atomic<std::uint64_t> done_{0};
};

}  // namespace

FilledGrid fill_grid(const Topology& topology, const Field& field, Sparsity sparsity, Progress* progress) {
  return Filler(topology, field, sparsity, progress).run();
}

void scale_values(openvdb::FloatGrid& grid, float factor) {
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid.tree());
  leaves.foreach ([factor](Leaf& leaf, std::size_t) {
    float* const values = leaf.buffer().data();
    for (unsigned voxel = 0; voxel < Leaf::SIZE; ++voxel) values[voxel] *= factor;
  });
  auto tile = grid.tree().beginValueAll();
  tile.setMaxDepth(openvdb::FloatTree::ValueAllIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) tile.setValue(*tile * factor);
}

}  // namespace solidnoise
