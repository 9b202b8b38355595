#include "solidnoise/noise/convolution/impulse_process.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidnoise {
namespace {

// Cumulative Poisson probabilities in units of 2^-64, up to where the rest is below 2^-64.
std::vector<std::uint64_t> cumulative_poisson(double mean) {
  std::vector<std::uint64_t> cumulative;
  double sum = 0.0;
  for (int count = 0;; ++count) {
    const double probability = std::exp(count * std::log(mean) - mean - std::lgamma(count + 1.0));
    sum += probability;
    const bool past_mode = count > mean;
    if (past_mode && (probability < 0x1.0p-64 || sum >= 1.0)) break;
    cumulative.push_back(sum >= 1.0 ? std::numeric_limits<std::uint64_t>::max()
                                    : static_cast<std::uint64_t>(std::ldexp(sum, 64)));
  }
  return cumulative;
}

}  // namespace

template <int Dim>
ImpulseProcess<Dim>::ImpulseProcess(const std::array<CellAxis, Dim>& axes, const ImpulseCount& count,
                                    std::uint64_t key)
    : axes_(axes), count_(count), key_(key) {
  if (count.is_fixed) return;
  cumulative_ = cumulative_poisson(count.mean);
  guide_ = static_cast<int>(count.mean);
}

template <int Dim>
int ImpulseProcess<Dim>::draw_count(std::uint64_t uniform) const {
  const int highest = static_cast<int>(cumulative_.size());
  int count = guide_ < highest ? guide_ : highest - 1;
  while (count > 0 && uniform < cumulative_[count - 1]) --count;
  while (count < highest && uniform >= cumulative_[count]) ++count;
  return count;
}

template class ImpulseProcess<1>;
template class ImpulseProcess<2>;
template class ImpulseProcess<3>;
template class ImpulseProcess<4>;

namespace {

// SIMD loads may read this far past a run's end.
constexpr std::size_t kPadding = 16;

}  // namespace

template <int Dim>
double ImpulseBlock<Dim>::Reach::cells() const {
  double product = 1.0;
  for (int axis = 0; axis < Dim; ++axis) product *= static_cast<double>(last[axis] - first[axis] + 1);
  return product;
}

template <int Dim>
typename ImpulseBlock<Dim>::Reach ImpulseBlock<Dim>::reach_of(const std::array<CellAxis, Dim>& axes,
                                                              const Box<Dim>& box, const Index<Dim>& cells) {
  Reach reach;
  for (int axis = 0; axis < Dim; ++axis) {
    const CellPosition lower = axes[axis].locate(box.lower[axis]);
    const CellPosition upper = axes[axis].locate(box.upper[axis]);
    reach.first[axis] = lower.cell - cells[axis];
    reach.last[axis] = upper.cell + cells[axis];
    reach.from_first[axis] = lower.fraction;
    reach.into_last[axis] = upper.fraction;
  }
  return reach;
}

template <int Dim>
ImpulseBlock<Dim>::ImpulseBlock(const ImpulseProcess<Dim>& process, const Reach& reach)
    : first_(reach.first) {
  std::array<std::int32_t, Dim> lowest;
  std::array<std::int32_t, Dim> highest;
  for (int axis = 0; axis < Dim; ++axis) {
    extent_[axis] = static_cast<std::size_t>(reach.last[axis] - reach.first[axis] + 1);
    lowest[axis] = static_cast<std::int32_t>(reach.from_first[axis] * kQuanta);
    highest[axis] = static_cast<std::int32_t>(extent_[axis] - 1) * kQuanta +
                    std::min(static_cast<std::int32_t>(reach.into_last[axis] * kQuanta), kQuanta - 1);
  }
  // As they are made, stratum by stratum; then in the order of their cells.
  const auto cells = static_cast<std::size_t>(reach.cells());
  const auto expected =
      static_cast<std::size_t>(process.mean_per_cell() * static_cast<double>(cells)) + kPadding;
  std::array<std::vector<std::int32_t>, Dim> positions;
  std::vector<std::uint64_t> marks;
  std::vector<std::uint32_t> cell_of;
  for (auto& of_axis : positions) of_axis.reserve(expected);
  marks.reserve(expected);
  cell_of.reserve(expected);
  starts_.assign(cells + 1, 0);
  const Index<Dim> first = reach.first - Index<Dim>(process.span() - 1);
  Index<Dim> stratum = first;
  do {
    process.generate(stratum, [&](const Impulse<Dim>& impulse) {
      std::array<std::int32_t, Dim> position;
      std::size_t cell = 0;
      for (int axis = 0; axis < Dim; ++axis) {
        position[axis] =
            static_cast<std::int32_t>(stratum[axis] - first_[axis]) * kQuanta + impulse.position[axis];
        if (position[axis] < lowest[axis] || position[axis] > highest[axis]) return;
        cell = cell * extent_[axis] + static_cast<std::size_t>(position[axis] / kQuanta);
      }
      for (int axis = 0; axis < Dim; ++axis) positions[axis].push_back(position[axis]);
      marks.push_back(impulse.mark);
      cell_of.push_back(static_cast<std::uint32_t>(cell));
      ++starts_[cell + 1];
    });
  } while (next_cell<Dim>(stratum, first, reach.last));
  for (std::size_t cell = 0; cell < cells; ++cell) starts_[cell + 1] += starts_[cell];

  for (auto& of_axis : positions_) of_axis.assign(marks.size() + kPadding, 0);
  marks_.resize(marks.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const std::uint32_t to = next[cell_of[i]]++;
    for (int axis = 0; axis < Dim; ++axis) positions_[axis][to] = positions[axis][i];
    marks_[to] = marks[i];
  }
}

template class ImpulseBlock<1>;
template class ImpulseBlock<2>;
template class ImpulseBlock<3>;
template class ImpulseBlock<4>;

}  // namespace solidnoise
