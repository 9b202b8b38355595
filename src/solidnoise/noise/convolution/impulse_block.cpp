#include "solidnoise/noise/convolution/impulse_block.h"

#include <cmath>

namespace solidnoise {
namespace {

// SIMD loads may read this far past a run's end.
constexpr std::size_t kPadding = 16;

}  // namespace

template <int Dim>
ImpulseBlock<Dim>::ImpulseBlock(const ImpulseProcess<Dim>& process, const ImpulseReach<Dim>& reach)
    : first_(reach.first) {
  std::array<std::int32_t, Dim> end;
  for (int axis = 0; axis < Dim; ++axis) {
    extent_[axis] = static_cast<std::size_t>(reach.last[axis] - reach.first[axis] + 1);
    end[axis] = static_cast<std::int32_t>(extent_[axis]) * kQuanta;
  }
  // As they are made, stratum by stratum; then in the order of their cells.
  struct Made {
    std::array<std::int32_t, Dim> position;
    std::uint32_t cell;
    std::uint64_t mark;
  };
  const auto cells = static_cast<std::size_t>(reach.cells());
  std::vector<Made> all;
  // Hardly ever more: growing would take three times as much.
  const double mean = process.mean_per_cell() * static_cast<double>(cells);
  all.reserve(static_cast<std::size_t>(mean + 4.0 * std::sqrt(mean) + 1.0));
  starts_.assign(cells + 1, 0);
  const auto take = [&](const FoundImpulse& found) {
    std::uint32_t cell = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const std::int32_t at = found.position(axis);
      if (at < 0 || at >= end[axis]) return;
      cell = cell * static_cast<std::uint32_t>(extent_[axis]) + static_cast<std::uint32_t>(at / kQuanta);
    }
    Made& made = all.emplace_back();
    for (int axis = 0; axis < Dim; ++axis) made.position[axis] = found.position(axis);
    made.cell = cell;
    made.mark = found.mark;
    ++starts_[cell + 1];
  };
  process.generate(reach.first - Index<Dim>(process.span() - 1), reach.last, reach, take);
  for (std::size_t cell = 0; cell < cells; ++cell) starts_[cell + 1] += starts_[cell];

  for (auto& of_axis : positions_) of_axis.assign(all.size() + kPadding, 0);
  marks_.resize(all.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const Made& made : all) {
    const std::uint32_t to = next[made.cell]++;
    for (int axis = 0; axis < Dim; ++axis) positions_[axis][to] = made.position[axis];
    marks_[to] = made.mark;
  }
}

template class ImpulseBlock<1>;
template class ImpulseBlock<2>;
template class ImpulseBlock<3>;
template class ImpulseBlock<4>;

}  // namespace solidnoise
