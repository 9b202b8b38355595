#include "solidnoise/volume/topology/fill.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_for.h>

namespace solidnoise {
namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;
using LeafMask = MaskLeaf::NodeMaskType;

// The voxel's value in a leaf's values, one component after the other.
template <typename Value>
Value gather(std::span<const float> values, std::size_t voxel) {
  if constexpr (std::is_same_v<Value, float>) {
    return values[voxel];
  } else {
    return {values[voxel], values[MaskLeaf::SIZE + voxel], values[2 * MaskLeaf::SIZE + voxel]};
  }
}

// Where the values of one grid go during a fill, leaf by leaf. Leaves may be stored in any order and by any
// thread, each index once.
class GridSink {
 public:
  virtual ~GridSink() = default;

  virtual void store_zeros(std::size_t index, const MaskLeaf& mask) = 0;
  // `values` has a leaf's values of one component after the other.
  virtual void store(std::size_t index, const MaskLeaf& mask, std::span<const float> values) = 0;
  // The grid of what was stored, its leaves in the order of their indices; once.
  virtual MeasuredGrid collect(const GridFrame& frame) = 0;
};

template <typename Tree>
class TypedSink final : public GridSink {
 public:
  TypedSink(std::size_t leaves, Sparsity sparsity) : sparsity_(sparsity), leaves_(leaves), moments_(leaves) {}

  void store_zeros(std::size_t index, const MaskLeaf& mask) override {
    if (sparsity_ == Sparsity::drop) return;
    auto leaf = make_leaf(mask);
    leaf->buffer().fill(Value(0.0f));
    keep(index, mask.valueMask(), std::move(leaf));
  }

  void store(std::size_t index, const MaskLeaf& mask, std::span<const float> values) override {
    auto leaf = make_leaf(mask);
    Value* const target = leaf->buffer().data();
    for (std::size_t voxel = 0; voxel < MaskLeaf::SIZE; ++voxel) target[voxel] = gather<Value>(values, voxel);
    LeafMask active = mask.valueMask();
    if (sparsity_ == Sparsity::drop) drop_zeros(active, target);
    if (active.isOff()) return;
    for (auto voxel = active.beginOff(); voxel; ++voxel) target[voxel.pos()] = Value(0.0f);
    keep(index, active, std::move(leaf));
  }

  MeasuredGrid collect(const GridFrame& frame) override {
    const auto grid = openvdb::Grid<Tree>::create(Value(0.0f));
    grid->setTransform(frame.transform());
    MeasuredGrid result{grid, std::vector<Moments>(kComponents)};
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      if (leaves_[i] == nullptr) continue;
      grid->tree().addLeaf(leaves_[i].release());
      for (std::size_t component = 0; component < kComponents; ++component) {
        result.moments[component].merge(moments_[i][component]);
      }
    }
    return result;
  }

 private:
  using Value = typename Tree::ValueType;
  using Leaf = typename Tree::LeafNodeType;
  static constexpr std::size_t kComponents = sizeof(Value) / sizeof(float);

  // A leaf with its memory, inactive; its values are to be written yet.
  static std::unique_ptr<Leaf> make_leaf(const MaskLeaf& mask) {
    auto leaf = std::make_unique<Leaf>(openvdb::PartialCreate(), mask.origin(), Value(0.0f), false);
    leaf->buffer().allocate();
    return leaf;
  }

  static void drop_zeros(LeafMask& active, const Value* values) {
    const Value zero(0.0f);
    for (unsigned word = 0; word < LeafMask::WORD_COUNT; ++word) {
      std::uint64_t not_zero = 0;
      for (unsigned bit = 0; bit < 64; ++bit) {
        not_zero |= static_cast<std::uint64_t>(values[64 * word + bit] != zero) << bit;
      }
      active.getWord<std::uint64_t>(word) &= not_zero;
    }
  }

  void keep(std::size_t index, const LeafMask& active, std::unique_ptr<Leaf> leaf) {
    leaf->setValueMask(active);
    if constexpr (kComponents == 1) {
      moments_[index] = {measure(*leaf)};
    } else {
      moments_[index] = measure(*leaf);
    }
    leaves_[index] = std::move(leaf);
  }

  Sparsity sparsity_;
  std::vector<std::unique_ptr<Leaf>> leaves_;  // in tree order; null where there is none
  std::vector<std::array<Moments, kComponents>> moments_;
};

std::unique_ptr<GridSink> make_grid_sink(int components, std::size_t leaves, Sparsity sparsity) {
  if (components == 1) return std::make_unique<TypedSink<openvdb::FloatTree>>(leaves, sparsity);
  if (components == 3) return std::make_unique<TypedSink<openvdb::Vec3STree>>(leaves, sparsity);
  throw std::invalid_argument(fmt::format("a grid of {} components; it must have 1 or 3", components));
}

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

// A group is of 64^3 voxels: large beside what blocks need around them, such as impulses and samples to
// interpolate from. Where there are not enough leaves for as many groups as threads may want, of 32^3.
constexpr int kGroupLog2 = 6;
constexpr int kSmallGroupLog2 = 5;
constexpr std::size_t kManyLeaves = 64 * 512;  // 64 full groups

// Leaves that are evaluated together, some five thousand voxels: most of what fields can share, while what
// they keep for each voxel stays so small that the memory for it is not fetched anew each time.
constexpr std::size_t kLeavesOfBlock = 10;

// Leaves that share a block: a run of indices in the list of grouped leaves.
struct LeafGroup {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// The topology's leaves in tree order, and the order of their indices that brings groups together.
struct GroupedLeaves {
  std::vector<const MaskLeaf*> leaves;
  std::vector<std::size_t> order;
  std::vector<LeafGroup> groups;
};

GroupedLeaves group_leaves(const openvdb::MaskTree& mask) {
  GroupedLeaves result;
  mask.getNodes(result.leaves);
  std::vector<std::pair<openvdb::Coord, std::size_t>> keys;
  keys.reserve(result.leaves.size());
  const int log2 = result.leaves.size() >= kManyLeaves ? kGroupLog2 : kSmallGroupLog2;
  for (std::size_t i = 0; i < result.leaves.size(); ++i) {
    const openvdb::Coord& origin = result.leaves[i]->origin();
    keys.emplace_back(openvdb::Coord(origin.x() >> log2, origin.y() >> log2, origin.z() >> log2), i);
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
  Filler(const Topology& topology, const Field<3>& field, const std::vector<GridChannels>& grids,
         Progress* progress)
      : frame_(topology.frame),
        field_(field),
        grids_(grids),
        progress_(progress),
        grouped_(group_leaves(*topology.mask)) {
    for (const GridChannels& grid : grids) {
      sinks_.push_back(make_grid_sink(grid.count, grouped_.leaves.size(), grid.sparsity));
    }
  }

  std::vector<MeasuredGrid> run() {
    tbb::parallel_for(std::size_t{0}, grouped_.groups.size(), [&](std::size_t group) {
      throw_if_cancelled(progress_);
      fill_group(grouped_.groups[group]);
    });
    throw_if_cancelled(progress_);
    std::vector<MeasuredGrid> grids;
    for (const auto& sink : sinks_) grids.push_back(sink->collect(frame_));
    return grids;
  }

 private:
  void fill_group(const LeafGroup& group) {
    // Gather the leaves that need the field, and the box that they span.
    openvdb::CoordBBox box;
    std::vector<std::size_t> wanted;
    for (std::size_t i = group.begin; i < group.end; ++i) {
      const std::size_t leaf = grouped_.order[i];
      const openvdb::CoordBBox voxels = grouped_.leaves[leaf]->getNodeBoundingBox();
      if (field_.empty(frame_.bounds(voxels))) {
        for (const auto& sink : sinks_) sink->store_zeros(leaf, *grouped_.leaves[leaf]);
      } else {
        wanted.push_back(leaf);
        box.expand(voxels);
      }
    }
    // Evaluate them.
    if (!wanted.empty()) {
      const std::unique_ptr<FieldBlock<3>> block = field_.block(frame_.bounds(box));
      for (std::size_t i = 0; i < wanted.size(); i += kLeavesOfBlock) {
        throw_if_cancelled(progress_);
        fill_leaves(*block, std::span(wanted).subspan(i, std::min(kLeavesOfBlock, wanted.size() - i)));
      }
    }
    if (progress_ != nullptr) progress_->advance(done_ += group.end - group.begin, grouped_.leaves.size());
  }

  void fill_leaves(const FieldBlock<3>& block, std::span<const std::size_t> leaves) {
    std::vector<Lattice<3>> lattices;
    for (const std::size_t leaf : leaves) {
      lattices.push_back(frame_.lattice(grouped_.leaves[leaf]->getNodeBoundingBox()));
    }
    const std::size_t size = static_cast<std::size_t>(field_.channels()) * MaskLeaf::SIZE;
    std::vector<float> values(leaves.size() * size);
    block.evaluate_all(lattices, {values, {}});
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      store(leaves[i], std::span(values).subspan(i * size, size));
    }
  }

  void store(std::size_t leaf, std::span<const float> values) {
    for (std::size_t i = 0; i < sinks_.size(); ++i) {
      const auto first = static_cast<std::size_t>(grids_[i].first) * MaskLeaf::SIZE;
      const auto size = static_cast<std::size_t>(grids_[i].count) * MaskLeaf::SIZE;
      sinks_[i]->store(leaf, *grouped_.leaves[leaf], values.subspan(first, size));
    }
  }

  const GridFrame& frame_;
  const Field<3>& field_;
  const std::vector<GridChannels>& grids_;
  Progress* const progress_;
  const GroupedLeaves grouped_;
  std::vector<std::unique_ptr<GridSink>> sinks_;
  std::atomic<std::uint64_t> done_{0};
};

}  // namespace

std::vector<MeasuredGrid> fill_grids(const Topology& topology, const Field<3>& field,
                                     const std::vector<GridChannels>& grids, Progress* progress) {
  for (const GridChannels& grid : grids) {
    if (grid.first >= 0 && grid.first + grid.count <= field.channels()) continue;
    throw std::invalid_argument(fmt::format("a field of {} channels for a grid of channels {} to {}",
                                            field.channels(), grid.first, grid.first + grid.count - 1));
  }
  return Filler(topology, field, grids, progress).run();
}

FilledGrid fill_grid(const Topology& topology, const Field<3>& field, Sparsity sparsity, Progress* progress) {
  if (field.channels() != 1) {
    throw std::invalid_argument(fmt::format("a field of {} channels for a grid of one", field.channels()));
  }
  const MeasuredGrid filled = fill_grids(topology, field, {{0, 1, sparsity}}, progress).front();
  return {openvdb::gridPtrCast<openvdb::FloatGrid>(filled.grid), filled.moments.front()};
}

void scale_values(openvdb::FloatGrid& grid, float factor) {
  using Leaf = openvdb::FloatTree::LeafNodeType;
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
