#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// One impulse of sparse white noise: where it is, and the key of its own random stream, from
// which the noise draws what else it needs (weight, phase, direction).
template <int Dim>
struct Impulse {
  std::array<std::int32_t, Dim> position;  // in 2^-20 of a cell
  std::uint64_t mark;                      // its last 24 bits are the share
};

// What an impulse draws first of what need not be independent of other impulses, as its weight and phase
// must: its frequency, its direction, its turn. A uniform number on [0, 1), in steps of 2^-24. Of the m
// impulses of a stratum one has a share in each m-th of [0, 1), so that a few impulses have of everything
// what many would have.
inline constexpr int kShareBits = 24;
inline constexpr std::uint64_t kShareMask = (std::uint64_t{1} << kShareBits) - 1;
inline double share_of(std::uint64_t mark) {
  return static_cast<double>(mark & kShareMask) / static_cast<double>(kShareMask + 1);
}

// How many impulses there are in a cell.
struct ImpulseCount {
  double mean = 1.0;      // > 0; whole if it is fixed
  bool is_fixed = false;  // the same in every stratum; else Poisson distributed
};

// A marked point process in Dim dimensions, cell by cell: strata, which hold a fixed number of impulses each,
// or a Poisson process. Positions are independent and uniform, and a cell's impulses are a function of its
// coordinates and the key alone (Lagae et al. 2009, section 4; we use an exact Poisson count and a hash that
// does not repeat).
//
// Strata are as large as cells but not where cells are: along the first axis all are shifted by one random
// number, along the second by one for each plane of strata, along the third by one for each row, and so on.
// So over the seeds the process is stationary, and in one noise no two axes show a grid.
template <int Dim>
class ImpulseProcess {
 public:
  // `key` from derive_seed.
  ImpulseProcess(const std::array<CellAxis, Dim>& axes, const ImpulseCount& count, std::uint64_t key);

  // A process of as many impulses per cell in other cells and with another key; quicker to make than anew.
  ImpulseProcess with(const std::array<CellAxis, Dim>& axes, std::uint64_t key) const {
    ImpulseProcess other = *this;
    other.axes_ = axes;
    other.key_ = key;
    return other;
  }

  const std::array<CellAxis, Dim>& axes() const { return axes_; }
  double mean_per_cell() const { return count_.mean; }
  // Cells along an axis that the impulses of a stratum may lie in: its own, and, where it is shifted, the
  // next.
  int span() const { return count_.is_fixed ? 2 : 1; }

  // Calls sink(impulse) for each impulse of a stratum, in a fixed order, at positions relative to the corner
  // of the cell of the same coordinates: 0 to span() cells. The strata of a Poisson process are its cells.
  template <typename Sink>
  void generate(const Index<Dim>& stratum, Sink&& sink) const {
    std::array<std::int32_t, Dim> shift{};
    std::uint64_t hash = key_;  // as hash_cell()
    for (int axis = 0; axis < Dim; ++axis) {
      if (count_.is_fixed) shift[axis] = static_cast<std::int32_t>(hash >> (64 - CellAxis::kFractionBits));
      hash = hash_coordinate(hash, axes_[axis].wrap(stratum[axis]));
    }
    RandomStream stream(hash);
    const int count = count_.is_fixed ? static_cast<int>(count_.mean) : draw_count(stream.next());
    for (int i = 0; i < count; ++i) {
      Impulse<Dim> impulse;
      for (int axis = 0; axis < Dim; axis += 2) {
        const std::uint64_t pair = stream.next();
        impulse.position[axis] =
            shift[axis] + static_cast<std::int32_t>(pair >> (64 - CellAxis::kFractionBits));
        if (axis + 1 < Dim) {
          impulse.position[axis + 1] =
              shift[axis + 1] +
              static_cast<std::int32_t>((pair & 0xffffffffULL) >> (32 - CellAxis::kFractionBits));
        }
      }
      impulse.mark = stream.next();
      if (count_.is_fixed) {
        const std::uint64_t within = impulse.mark & kShareMask;
        impulse.mark +=
            ((static_cast<std::uint64_t>(i) << kShareBits) + within) / static_cast<std::uint64_t>(count) -
            within;
      }
      sink(impulse);
    }
  }

 private:
  // The Poisson count whose cumulative probability first exceeds a uniform 64-bit number.
  int draw_count(std::uint64_t uniform) const;

  std::array<CellAxis, Dim> axes_;
  ImpulseCount count_;
  std::uint64_t key_;
  std::vector<std::uint64_t> cumulative_;  // of counts 0, 1, ... in 2^-64
  int guide_ = 0;                          // where the search starts
};

extern template class ImpulseProcess<1>;
extern template class ImpulseProcess<2>;
extern template class ImpulseProcess<3>;
extern template class ImpulseProcess<4>;

// Moves to the next cell of a range, last axis fastest; false after the last one.
template <int Dim>
bool next_cell(Index<Dim>& cell, const Index<Dim>& first, const Index<Dim>& last) {
  for (int axis = Dim - 1; axis >= 0; --axis) {
    if (++cell[axis] <= last[axis]) return true;
    cell[axis] = first[axis];
  }
  return false;
}

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
// again. A cell is a cube of `parts` strata along each axis, and has their impulses.
template <int Dim>
class ImpulseCells {
 public:
  struct Item {
    std::array<float, Dim> position;  // in cells, from the cell's corner, 0 to span()
    float weight;                     // 1 or -1, times the factor of its mark
    float share;                      // uniform on [0, 1)
  };

  using Factor = std::function<double(std::uint64_t mark)>;  // empty: 1

  explicit ImpulseCells(ImpulseProcess<Dim> process, int parts = 1, Factor factor = {})
      : process_(std::move(process)),
        parts_(parts),
        axis_(parts * process_.axes()[0].size()),
        factor_(std::move(factor)),
        slots_(kSlots) {}

  const CellAxis& axis() const { return axis_; }
  // Cells along an axis that the impulses of a cell may lie in.
  static float span(const ImpulseProcess<Dim>& process, int parts) {
    return 1.0f + static_cast<float>(process.span() - 1) / static_cast<float>(parts);
  }

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
  static constexpr int kSlotBits = Dim == 4 ? 15 : 13;
  static constexpr std::size_t kSlots = std::size_t{1} << kSlotBits;
  static constexpr std::size_t kMostItems = 32 * kSlots;

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
    Index<Dim> part(0);
    const Index<Dim> first(0);
    const Index<Dim> last(parts_ - 1);
    do {
      process_.generate(cell * std::int64_t{parts_} + part,
                        [&](const Impulse<Dim>& impulse) { add(impulse, part); });
    } while (next_cell<Dim>(part, first, last));
    slot.count = static_cast<std::uint32_t>(items_.size()) - slot.first;
  }

  void add(const Impulse<Dim>& impulse, const Index<Dim>& part) {
    Item item;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const std::int64_t place = part[axis] * CellAxis::kQuantaPerCell + impulse.position[a];
      item.position[a] = static_cast<float>(place) / static_cast<float>(parts_ * CellAxis::kQuantaPerCell);
    }
    item.weight = impulse.mark >> 63 ? 1.0f : -1.0f;
    if (factor_) item.weight *= static_cast<float>(factor_(impulse.mark));
    item.share = static_cast<float>(share_of(impulse.mark));
    items_.push_back(item);
  }

  ImpulseProcess<Dim> process_;
  int parts_;
  CellAxis axis_;
  Factor factor_;
  std::vector<Slot> slots_;
  std::vector<Item> items_;
};

}  // namespace solidnoise
