#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/convolution/impulse_process.h"

namespace solidnoise {

// The impulses within reach of some samples, sorted by cell (last axis fastest), ready for culling.
template <int Dim>
class ImpulseBlock {
 public:
  static constexpr int kQuanta = 1 << CellAxis::kFractionBits;  // of a cell
  static constexpr std::int64_t kMaxCellsPerAxis = 1000;        // so that a position fits 32 bits

  // Precondition: at most kMaxCellsPerAxis cells along each axis.
  ImpulseBlock(const ImpulseProcess<Dim>& process, const ImpulseReach<Dim>& reach);

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

}  // namespace solidnoise
