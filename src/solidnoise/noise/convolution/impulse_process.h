#pragma once

#include <array>
#include <cstdint>
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

}  // namespace solidnoise
