#include "solidnoise/noise/impulse_block.h"

namespace solidnoise {
namespace {

// Moves to the next cell of a range, last axis fastest; false after the last one.
template <int Dim>
bool advance(Index<Dim>& cell, const Index<Dim>& first, const Index<Dim>& last) {
  for (int axis = Dim - 1; axis >= 0; --axis) {
    if (++cell[axis] <= last[axis]) return true;
    cell[axis] = first[axis];
  }
  return false;
}

// SIMD loads may read this far past a run's end.
constexpr std::size_t kPadding = 16;

}  // namespace

template <int Dim>
double ImpulseBlock<Dim>::CellRange::cells() const {
  double product = 1.0;
  for (int axis = 0; axis < Dim; ++axis) product *= static_cast<double>(last[axis] - first[axis] + 1);
  return product;
}

template <int Dim>
typename ImpulseBlock<Dim>::CellRange ImpulseBlock<Dim>::cells_within_reach(
    const std::array<CellAxis, Dim>& axes, const Box<Dim>& box) {
  CellRange range;
  for (int axis = 0; axis < Dim; ++axis) {
    range.first[axis] = axes[axis].locate(box.lower[axis]).cell - 1;
    range.last[axis] = axes[axis].locate(box.upper[axis]).cell + 1;
  }
  return range;
}

template <int Dim>
ImpulseBlock<Dim>::ImpulseBlock(const ImpulseProcess<Dim>& process, const CellRange& range) : range_(range) {
  for (int axis = 0; axis < Dim; ++axis) {
    extent_[axis] = static_cast<std::size_t>(range.last[axis] - range.first[axis] + 1);
  }
  const auto cells = static_cast<std::size_t>(range.cells());
  const auto expected =
      static_cast<std::size_t>(process.mean_per_cell() * static_cast<double>(cells) * 1.1) + 64;
  for (auto& positions : positions_) positions.reserve(expected + kPadding);
  marks_.reserve(expected);
  starts_.reserve(cells + 1);

  Index<Dim> cell = range.first;
  do {
    starts_.push_back(static_cast<std::uint32_t>(marks_.size()));
    process.generate(cell, [&](const Impulse<Dim>& impulse) {
      for (int axis = 0; axis < Dim; ++axis) {
        const auto corner = static_cast<std::int32_t>((cell[axis] - range.first[axis]) * kQuanta);
        positions_[axis].push_back(corner + impulse.position[axis]);
      }
      marks_.push_back(impulse.mark);
    });
  } while (advance<Dim>(cell, range.first, range.last));
  starts_.push_back(static_cast<std::uint32_t>(marks_.size()));
  for (auto& positions : positions_) positions.resize(marks_.size() + kPadding, 0);
}

template class ImpulseBlock<1>;
template class ImpulseBlock<2>;
template class ImpulseBlock<3>;
template class ImpulseBlock<4>;

}  // namespace solidnoise
