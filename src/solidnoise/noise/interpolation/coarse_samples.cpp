#include "solidnoise/noise/interpolation/coarse_samples.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace solidnoise {
namespace {

constexpr std::size_t kMostKept = std::size_t{1} << 24;  // samples

// Visits all index vectors of 0 <= index < count, the last axis fastest.
template <int Dim, typename Visit>
void for_each_index(const glm::vec<Dim, int>& count, const Visit& visit) {
  glm::vec<Dim, int> index(0);
  while (true) {
    visit(index);
    int axis = Dim - 1;
    while (axis >= 0 && ++index[axis] == count[axis]) index[axis--] = 0;
    if (axis < 0) return;
  }
}

template <int Dim>
std::size_t offset_of(const glm::vec<Dim, int>& index, const glm::vec<Dim, int>& count) {
  std::size_t offset = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    offset = offset * static_cast<std::size_t>(count[axis]) + static_cast<std::size_t>(index[axis]);
  }
  return offset;
}

// Copies a box of `count` samples, row by row, between two dense arrays.
template <int Dim>
void copy_box(const glm::vec<Dim, int>& count, const float* from, const glm::vec<Dim, int>& from_start,
              const glm::vec<Dim, int>& from_count, float* to, const glm::vec<Dim, int>& to_start,
              const glm::vec<Dim, int>& to_count) {
  from += offset_of<Dim>(from_start, from_count);
  to += offset_of<Dim>(to_start, to_count);
  const auto from_row = static_cast<std::size_t>(from_count[Dim - 1]);
  const auto to_row = static_cast<std::size_t>(to_count[Dim - 1]);
  const int slabs = Dim == 3 ? count[0] : 1;
  for (int x = 0; x < slabs; ++x) {
    const std::size_t first = static_cast<std::size_t>(x);
    const float* source = from + first * static_cast<std::size_t>(from_count[Dim - 2]) * from_row;
    float* target = to + first * static_cast<std::size_t>(to_count[Dim - 2]) * to_row;
    for (int y = 0; y < count[Dim - 2]; ++y, source += from_row, target += to_row) {
      std::copy_n(source, count[Dim - 1], target);
    }
  }
}

}  // namespace

template <int Dim>
CoarseSamples<Dim>::CoarseSamples(std::shared_ptr<const Noise<Dim>> noise, const Lattice<Dim>& lattice,
                                  const SampleRange<Dim>& range)
    : noise_(std::move(noise)), lattice_(lattice), range_(range) {
  std::size_t bricks = 1;
  double samples = 1.0;  // in double: may be huge
  for (int axis = 0; axis < Dim; ++axis) {
    bricks_[axis] = (range.count[axis] + kSide - 1) / kSide;
    bricks *= static_cast<std::size_t>(bricks_[axis]);
    samples *= range.count[axis];
  }
  if (samples > static_cast<double>(kMostKept)) return;
  block_ = noise_->block(lattice_of(range).bounds());
  samples_.resize(range.size());
  evaluated_.resize(bricks, false);
}

template <int Dim>
Lattice<Dim> CoarseSamples<Dim>::lattice_of(const SampleRange<Dim>& part) const {
  Lattice<Dim> lattice = lattice_;
  lattice.first = part.first;
  lattice.count = part.count;
  return lattice;
}

template <int Dim>
void CoarseSamples<Dim>::copy(const SampleRange<Dim>& part, std::span<float> to) {
  if (samples_.empty()) {
    const Lattice<Dim> lattice = lattice_of(part);
    noise_->block(lattice.bounds())->evaluate(lattice, Samples<Dim>{to.first(part.size()), {}});
    return;
  }
  glm::vec<Dim, int> start;
  glm::vec<Dim, int> first_brick;
  glm::vec<Dim, int> brick_count;
  for (int axis = 0; axis < Dim; ++axis) {
    start[axis] = static_cast<int>(part.first[axis] - range_.first[axis]);
    first_brick[axis] = start[axis] / kSide;
    brick_count[axis] = (start[axis] + part.count[axis] - 1) / kSide - first_brick[axis] + 1;
  }
  for_each_index<Dim>(brick_count, [&](const glm::vec<Dim, int>& index) {
    const glm::vec<Dim, int> brick = first_brick + index;
    if (!evaluated_[offset_of<Dim>(brick, bricks_)]) evaluate_brick(brick);
  });
  copy_box<Dim>(part.count, samples_.data(), start, range_.count, to.data(), glm::vec<Dim, int>(0),
                part.count);
}

template <int Dim>
void CoarseSamples<Dim>::evaluate_brick(const glm::vec<Dim, int>& brick) {
  SampleRange<Dim> part;
  const glm::vec<Dim, int> start = brick * kSide;
  for (int axis = 0; axis < Dim; ++axis) {
    part.first[axis] = range_.first[axis] + start[axis];
    part.count[axis] = std::min(kSide, range_.count[axis] - start[axis]);
  }
  std::vector<float> samples(part.size());
  block_->evaluate(lattice_of(part), Samples<Dim>{samples, {}});
  copy_box<Dim>(part.count, samples.data(), glm::vec<Dim, int>(0), part.count, samples_.data(), start,
                range_.count);
  evaluated_[offset_of<Dim>(brick, bricks_)] = true;
}

template class CoarseSamples<2>;
template class CoarseSamples<3>;

}  // namespace solidnoise
