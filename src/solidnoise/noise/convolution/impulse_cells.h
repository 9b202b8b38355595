#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/noise/convolution/impulse_process.h"

namespace solidnoise {

// The impulses of the cells that were asked for last, so that cells near each other are not made again and
// again.
template <int Dim>
class ImpulseCells {
 public:
  struct Item {
    std::array<float, Dim> position;  // in the cell, 0 to 1, exact
    float weight;                     // 1 or -1
    float share;                      // uniform on [0, 1)
  };

  explicit ImpulseCells(ImpulseProcess<Dim> process) : process_(std::move(process)), slots_(kSlots) {}

  const CellAxis& axis() const { return process_.axes()[0]; }

  // Valid until the next call.
  std::span<const Item> at(const Index<Dim>& cell) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      hash = (hash + static_cast<std::uint64_t>(cell[axis])) * 0x9e3779b97f4a7c15ULL;
    }
    Slot& slot = slots_[hash >> (64 - kSlotBits)];
    if (!slot.filled || slot.cell != cell) fill(slot, cell);
    return std::span(items_).subspan(slot.first, slot.count);
  }

 private:
  static constexpr int kSlotBits = Dim == 4 ? 13 : 11;
  static constexpr std::size_t kSlots = std::size_t{1} << kSlotBits;
  static constexpr std::size_t kMostItems = 16 * kSlots;

  // A cell and its part of the items.
  struct Slot {
    Index<Dim> cell{0};
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool filled = false;
  };

  void fill(Slot& slot, const Index<Dim>& cell) {
    if (items_.size() > kMostItems) {
      items_.clear();
      for (Slot& any : slots_) any.filled = false;
    }
    slot.cell = cell;
    slot.filled = true;
    slot.first = static_cast<std::uint32_t>(items_.size());
    process_.generate(cell, [&](const Impulse<Dim>& impulse) {
      Item item;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        item.position[axis] =
            static_cast<float>(impulse.position[axis]) / static_cast<float>(CellAxis::kQuantaPerCell);
      }
      item.weight = impulse.mark >> 63 ? 1.0f : -1.0f;
      item.share = static_cast<float>(impulse.mark & 0xffffffu) * 0x1p-24f;
      items_.push_back(item);
    });
    slot.count = static_cast<std::uint32_t>(items_.size()) - slot.first;
  }

  ImpulseProcess<Dim> process_;
  std::vector<Slot> slots_;
  std::vector<Item> items_;
};

}  // namespace solidnoise
