#include "solidnoise/noise/interpolation/lattice_interpolation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "solidnoise/noise/interpolation/lattice_frame.h"

namespace solidnoise {
namespace {

template <int Dim>
Lattice<Dim> coarse_lattice(const LatticeFrame<Dim>& frame, const LatticeWeights& weights) {
  Lattice<Dim> lattice{frame.origin, frame.step, {}, {}};
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.step[axis] *= weights.values[static_cast<std::size_t>(axis)].shape().step;
  }
  return lattice;
}

std::vector<float> rounded(const AxisWeights& exact) {
  std::vector<float> weights;
  for (int phase = 0; phase < exact.shape().step; ++phase) {
    for (const double weight : exact.of_phase(phase)) weights.push_back(static_cast<float>(weight));
  }
  return weights;
}

// The coarse samples that samples in the box may need.
template <int Dim>
SampleRange<Dim> coarse_range(const LatticeInterpolation<Dim>& interpolation, const Box<Dim>& box) {
  constexpr double kTolerance = 1e-6;  // samples: what the box's corners may be rounded by
  const LatticeFrame<Dim>& frame = interpolation.frame();
  Index<Dim> begin;
  Index<Dim> end;
  for (int axis = 0; axis < Dim; ++axis) {
    const double lower = (box.lower[axis] - frame.origin[axis]) / frame.step[axis];
    const double upper = (box.upper[axis] - frame.origin[axis]) / frame.step[axis];
    begin[axis] = static_cast<std::int64_t>(std::floor(lower + kTolerance));
    end[axis] = static_cast<std::int64_t>(std::ceil(upper - kTolerance));
  }
  return interpolation.coarse_range(begin, end);
}

float* room_in(std::vector<float>& buffer, std::size_t size) {
  if (buffer.size() < size) buffer.resize(size);
  return buffer.data();
}

}  // namespace

template <int Dim>
LatticeInterpolation<Dim>::LatticeInterpolation(const std::shared_ptr<const Noise<Dim>>& noise,
                                                const LatticeFrame<Dim>& frame, const LatticeWeights& weights)
    : frame_(frame), store_(noise, coarse_lattice(frame, weights)) {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    axes_.push_back({weights.values[axis].shape(), {rounded(weights.values[axis])}});
    if (!weights.slopes.empty()) axes_.back().weights[1] = rounded(weights.slopes[axis]);
  }
}

template <int Dim>
SampleRange<Dim> LatticeInterpolation<Dim>::coarse_range(const Index<Dim>& begin,
                                                         const Index<Dim>& end) const {
  SampleRange<Dim> range;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto [step, taps] = axis_of(axis).shape;
    range.first[axis] = divide_down(begin[axis], step) - (taps - 1) / 2;
    const std::int64_t count = divide_down(end[axis], step) + taps / 2 - range.first[axis] + 1;
    range.count[axis] = static_cast<int>(std::min<std::int64_t>(count, std::numeric_limits<int>::max()));
  }
  return range;
}

template <int Dim>
std::int64_t LatticeInterpolation<Dim>::phase(int axis, std::int64_t begin) const {
  const int step = axis_of(axis).shape.step;
  return begin - divide_down(begin, step) * step;
}

template <int Dim>
AxisTaps LatticeInterpolation<Dim>::taps(int axis, AxisWeights::Of of, std::int64_t begin, int count) const {
  const auto [step, taps] = axis_of(axis).shape;
  const std::vector<float>& weights = axis_of(axis).weights[of == AxisWeights::Of::values ? 0 : 1];
  std::vector<std::size_t> first;
  std::vector<float> weight;
  for (std::int64_t i = begin; i < begin + count; ++i) {
    const std::int64_t coarse = divide_down(i, step);
    const auto of_phase = weights.begin() + static_cast<std::ptrdiff_t>((i - coarse * step) * taps);
    first.push_back(static_cast<std::size_t>(coarse - divide_down(begin, step)));
    weight.insert(weight.end(), of_phase, of_phase + taps);
  }
  return {taps, std::move(first), std::move(weight)};
}

template <int Dim>
LatticeInterpolator<Dim>::LatticeInterpolator(const LatticeInterpolation<Dim>& interpolation,
                                              const Box<Dim>& box)
    : interpolation_(interpolation), coarse_(interpolation.store(), coarse_range<Dim>(interpolation, box)) {}

template <int Dim>
void LatticeInterpolator<Dim>::values(const Lattice<Dim>& lattice, std::span<float> values) {
  interpolate(lattice, Quantity::values, {values.data()});
}

template <int Dim>
void LatticeInterpolator<Dim>::gradient(const Lattice<Dim>& lattice,
                                        const std::array<std::span<float>, Dim>& gradient) {
  std::array<float*, 1 + Dim> out{};
  for (std::size_t axis = 0; axis < Dim; ++axis) out[1 + axis] = gradient[axis].data();
  interpolate(lattice, Quantity::gradient, out);
}

// From the last axis to the first: the arrays in between are then the smallest where each value costs most.
template <int Dim>
void LatticeInterpolator<Dim>::interpolate(const Lattice<Dim>& lattice, Quantity quantity,
                                           const std::array<float*, 1 + Dim>& out) {
  using Of = AxisWeights::Of;
  const bool gradient = quantity == Quantity::gradient;
  Index<Dim> end;
  for (int axis = 0; axis < Dim; ++axis) end[axis] = lattice.first[axis] + lattice.count[axis] - 1;
  const SampleRange<Dim> range = interpolation_.coarse_range(lattice.first, end);
  const SampleRows coarse = coarse_.rows(range);
  AxisShape shape{range.size(), 1, 1};
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const auto count = static_cast<std::size_t>(lattice.count[axis]);
    shape.in = static_cast<std::size_t>(range.count[axis]);
    shape.outer /= shape.in;
    std::swap(from_, to_);
    const auto pass = [&](Of of, std::size_t from, std::size_t to) {
      float* const made = axis == 0 ? out[to] : room_in(to_[to], shape.outer * count * shape.inner);
      const AxisTaps& taps = taps_of(axis, of, lattice);
      if (axis == Dim - 1) {
        interpolate_last_axis(taps, coarse, made);
      } else {
        interpolate_axis(taps, shape, from_[from].data(), made);
      }
    };
    if (axis > 0 || !gradient) pass(Of::values, 0, 0);
    if (gradient) {
      pass(Of::slopes, 0, static_cast<std::size_t>(1 + axis));
      for (auto other = static_cast<std::size_t>(2 + axis); other <= Dim; ++other) {
        pass(Of::values, other, other);
      }
    }
    shape.inner *= count;
  }
}

template <int Dim>
const AxisTaps& LatticeInterpolator<Dim>::taps_of(int axis, AxisWeights::Of of, const Lattice<Dim>& lattice) {
  const std::int64_t phase = interpolation_.phase(axis, lattice.first[axis]);
  const int count = lattice.count[axis];
  auto& all = taps_[static_cast<std::size_t>(axis)][of == AxisWeights::Of::values ? 0 : 1];
  const auto known = std::find_if(all.begin(), all.end(), [&](const KnownTaps& taps) {
    return taps.phase == phase && taps.count == count;
  });
  if (known != all.end()) return *known->taps;
  all.push_back({phase, count, std::make_unique<AxisTaps>(interpolation_.taps(axis, of, phase, count))});
  return *all.back().taps;
}

template class LatticeInterpolation<2>;
template class LatticeInterpolation<3>;
template class LatticeInterpolator<2>;
template class LatticeInterpolator<3>;

}  // namespace solidnoise
