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
SampleRows CoarseSamples<Dim>::rows(const SampleRange<Dim>& part) {
  if (samples_.empty()) {
    const Lattice<Dim> lattice = lattice_of(part);
    passing_.resize(part.size());
    noise_->block(lattice.bounds())->evaluate(lattice, Samples<Dim>{passing_, {}});
    return rows_of(passing_, part.count, glm::vec<Dim, int>(0), part.count);
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
  return rows_of(samples_, range_.count, start, part.count);
}

// The part of a dense array of `count` samples that begins at `start`.
template <int Dim>
SampleRows CoarseSamples<Dim>::rows_of(const std::vector<float>& samples, const glm::vec<Dim, int>& count,
                                       const glm::vec<Dim, int>& start,
                                       const glm::vec<Dim, int>& part) const {
  SampleRows rows;
  rows.first = samples.data() + offset_of<Dim>(start, count);
  rows.rows = static_cast<std::size_t>(part[Dim - 2]);
  rows.row_stride = static_cast<std::size_t>(count[Dim - 1]);
  if constexpr (Dim == 3) {
    rows.slabs = static_cast<std::size_t>(part[0]);
    rows.slab_stride = rows.row_stride * static_cast<std::size_t>(count[1]);
  }
  return rows;
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
  const float* from = samples.data();
  glm::vec<Dim, int> rows = part.count;
  rows[Dim - 1] = 1;
  for_each_index<Dim>(rows, [&](const glm::vec<Dim, int>& row) {
    std::copy_n(from, part.count[Dim - 1], samples_.data() + offset_of<Dim>(start + row, range_.count));
    from += part.count[Dim - 1];
  });
  evaluated_[offset_of<Dim>(brick, bricks_)] = true;
}

template class CoarseSamples<2>;
template class CoarseSamples<3>;

}  // namespace solidnoise
