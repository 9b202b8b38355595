#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// One impulse of sparse white noise: where it is in its cell, and the key of its own random stream, from
// which the noise draws what else it needs (weight, phase, direction).
template <int Dim>
struct Impulse {
  std::array<std::int32_t, Dim> position;  // in 2^-20 of a cell, 0 to 2^20 - 1
  std::uint64_t mark;
};

// A marked Poisson process in Dim dimensions, cell by cell: the number of impulses in a cell is Poisson
// distributed, their positions are uniform, and different cells are independent. A cell's impulses are a
// function of the cell's coordinates and the key alone (Lagae et al. 2009, section 4; we use an exact Poisson
// count and a hash that does not repeat).
template <int Dim>
class ImpulseProcess {
 public:
  // `mean_per_cell` > 0; `key` from derive_seed.
  ImpulseProcess(const std::array<CellAxis, Dim>& axes, double mean_per_cell, std::uint64_t key);

  // A process of as many impulses per cell in other cells and with another key; quicker to make than anew.
  ImpulseProcess with(const std::array<CellAxis, Dim>& axes, std::uint64_t key) const {
    ImpulseProcess other = *this;
    other.axes_ = axes;
    other.key_ = key;
    return other;
  }

  const std::array<CellAxis, Dim>& axes() const { return axes_; }
  double mean_per_cell() const { return mean_per_cell_; }

  // Calls sink(impulse) for each impulse of the cell, in a fixed order.
  template <typename Sink>
  void generate(const Index<Dim>& cell, Sink&& sink) const {
    Index<Dim> source;
    for (int axis = 0; axis < Dim; ++axis) source[axis] = axes_[axis].wrap(cell[axis]);
    RandomStream stream(hash_cell<Dim>(source, key_));
    const int count = draw_count(stream.next());
    for (int i = 0; i < count; ++i) {
      Impulse<Dim> impulse;
      for (int axis = 0; axis < Dim; axis += 2) {
        const std::uint64_t pair = stream.next();
        impulse.position[axis] = static_cast<std::int32_t>(pair >> (64 - CellAxis::kFractionBits));
        if (axis + 1 < Dim) {
          impulse.position[axis + 1] =
              static_cast<std::int32_t>((pair & 0xffffffffULL) >> (32 - CellAxis::kFractionBits));
        }
      }
      impulse.mark = stream.next();
      sink(impulse);
    }
  }

 private:
  // The Poisson count whose cumulative probability first exceeds a uniform 64-bit number.
  int draw_count(std::uint64_t uniform) const;

  std::array<CellAxis, Dim> axes_;
  double mean_per_cell_;
  std::uint64_t key_;
  std::vector<std::uint64_t> cumulative_;  // of counts 0, 1, ... in 2^-64
  int guide_ = 0;                          // where the search starts
};

extern template class ImpulseProcess<1>;
extern template class ImpulseProcess<2>;
extern template class ImpulseProcess<3>;
extern template class ImpulseProcess<4>;

// The impulses of all cells within reach of a box, sorted by cell (last axis fastest), ready for culling.
template <int Dim>
class ImpulseBlock {
 public:
  static constexpr int kQuanta = 1 << CellAxis::kFractionBits;  // of a cell
  static constexpr std::int64_t kMaxCellsPerAxis = 1000;        // so that a position fits 32 bits

  // The cells whose impulses may reach some samples, and within them the positions that do.
  struct Reach {
    Index<Dim> first{0};  // cells
    Index<Dim> last{0};
    std::array<float, Dim> from_first{};  // positions: from this far into the first cell, 0 to 1,
    std::array<float, Dim> into_last{};   // to this far into the last

    double cells() const;  // in double: may be huge
  };
  // `cells`: how far an impulse reaches along each axis, rounded up.
  static Reach reach_of(const std::array<CellAxis, Dim>& axes, const Box<Dim>& box, const Index<Dim>& cells);

  // Precondition: at most kMaxCellsPerAxis cells along each axis.
  ImpulseBlock(const ImpulseProcess<Dim>& process, const Reach& reach);

  const Index<Dim>& first_cell() const { return first_; }
  std::size_t size() const { return marks_.size(); }

  // Position of each impulse relative to the first cell's corner, in 2^-20 of a cell.
  const std::int32_t* position(int axis) const { return positions_[axis].data(); }
  const std::vector<std::uint64_t>& marks() const { return marks_; }

  // Impulses of the cells `from` to `to` (inclusive) on the last axis and `cell` on the others:
  // a contiguous run [begin, end).
  struct Run {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  Run run(const Index<Dim>& cell, std::int64_t from, std::int64_t to) const {
    std::size_t row = 0;
    for (int axis = 0; axis + 1 < Dim; ++axis) {
      row = row * extent_[axis] + static_cast<std::size_t>(cell[axis] - first_[axis]);
    }
    const std::size_t base = row * extent_[Dim - 1];
    return {starts_[base + static_cast<std::size_t>(from - first_[Dim - 1])],
            starts_[base + static_cast<std::size_t>(to - first_[Dim - 1]) + 1]};
  }

 private:
  Index<Dim> first_;
  std::array<std::size_t, Dim> extent_{};
  std::array<std::vector<std::int32_t>, Dim> positions_;
  std::vector<std::uint64_t> marks_;
  std::vector<std::uint32_t> starts_;  // of each cell's impulses, and the end of the last
};

extern template class ImpulseBlock<1>;
extern template class ImpulseBlock<2>;
extern template class ImpulseBlock<3>;
extern template class ImpulseBlock<4>;

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
