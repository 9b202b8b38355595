#include "solidnoise/volume/grid_sink.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace solidnoise {
namespace {

using MaskLeaf = GridSink::MaskLeaf;
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

template <typename Tree>
class TypedSink final : public GridSink {
 public:
  TypedSink(std::size_t leaves, Sparsity sparsity) : sparsity_(sparsity), leaves_(leaves), moments_(leaves) {}

  std::size_t components() const override { return kComponents; }

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

}  // namespace

std::unique_ptr<GridSink> make_grid_sink(int components, std::size_t leaves, Sparsity sparsity) {
  if (components == 1) return std::make_unique<TypedSink<openvdb::FloatTree>>(leaves, sparsity);
  if (components == 3) return std::make_unique<TypedSink<openvdb::Vec3STree>>(leaves, sparsity);
  throw std::invalid_argument(fmt::format("a grid of {} components; it must have 1 or 3", components));
}

}  // namespace solidnoise
