#include "solidnoise/noise/interpolation/coarse_samples.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "solidnoise/noise/interpolation/lattice_frame.h"

namespace solidnoise {

template <int Dim>
std::int64_t CoarseStore<Dim>::brick_of(std::int64_t sample) {
  return divide_down(sample + kBefore, kBrickSide);
}

template <int Dim>
CoarseStore<Dim>::CoarseStore(std::shared_ptr<const Noise<Dim>> noise, const Lattice<Dim>& lattice)
    : noise_(std::move(noise)), lattice_(lattice) {}

template <int Dim>
Lattice<Dim> CoarseStore<Dim>::lattice_of(const Index<Dim>& first_brick, int bricks) const {
  Lattice<Dim> lattice = lattice_;
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.first[axis] = first_sample(first_brick[axis]);
    lattice.count[axis] = bricks * kBrickSide;
  }
  return lattice;
}

template <int Dim>
std::shared_ptr<typename CoarseStore<Dim>::Tile> CoarseStore<Dim>::tile_of(const Index<Dim>& brick) {
  constexpr std::size_t kMostTiles = kMostBytes / (power(kTileBricks) * kBrickSamples * sizeof(float));
  Place place;
  Index<Dim> first_brick;
  for (int axis = 0; axis < Dim; ++axis) {
    place[static_cast<std::size_t>(axis)] = divide_down(brick[axis], kTileBricks);
    first_brick[axis] = place[static_cast<std::size_t>(axis)] * kTileBricks;
  }
  const std::scoped_lock lock(mutex_);
  if (const auto known = tiles_.find(place); known != tiles_.end()) {
    recent_.splice(recent_.begin(), recent_, known->second);
  } else {
    recent_.emplace_front(place, std::make_shared<Tile>(*this, first_brick));
    tiles_.emplace(place, recent_.begin());
  }
  if (recent_.size() > kMostTiles) {
    tiles_.erase(recent_.back().first);
    recent_.pop_back();
  }
  return recent_.front().second;
}

template <int Dim>
CoarseStore<Dim>::Tile::Tile(const CoarseStore& store, const Index<Dim>& first_brick)
    : store_(store), first_brick_(first_brick), evaluated_(missing_, false) {}

template <int Dim>
std::span<const float> CoarseStore<Dim>::Tile::brick(const Index<Dim>& brick) {
  std::size_t number = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    number = number * kTileBricks + static_cast<std::size_t>(brick[axis] - first_brick_[axis]);
  }
  const std::scoped_lock lock(mutex_);
  if (!samples_) samples_ = std::make_unique_for_overwrite<float[]>(power(kTileBricks) * kBrickSamples);
  const std::span<float> samples(samples_.get() + number * kBrickSamples, kBrickSamples);
  if (evaluated_[number]) return samples;
  if (!block_) block_ = store_.noise_->block(store_.lattice_of(first_brick_, kTileBricks).bounds());
  block_->evaluate(store_.lattice_of(brick, 1), Samples<Dim>{samples, {}});
  evaluated_[number] = true;
  if (--missing_ == 0) block_.reset();
  return samples;
}

template class CoarseStore<2>;
template class CoarseStore<3>;

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

template <int Dim, typename Integer>
std::size_t offset_of(const glm::vec<Dim, Integer>& index, const glm::vec<Dim, int>& count) {
  std::size_t offset = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    offset = offset * static_cast<std::size_t>(count[axis]) + static_cast<std::size_t>(index[axis]);
  }
  return offset;
}

// The bricks that a range of samples touches.
template <int Dim>
SampleRange<Dim> bricks_of(const SampleRange<Dim>& samples) {
  SampleRange<Dim> bricks;
  for (int axis = 0; axis < Dim; ++axis) {
    bricks.first[axis] = CoarseStore<Dim>::brick_of(samples.first[axis]);
    bricks.count[axis] = static_cast<int>(
        CoarseStore<Dim>::brick_of(samples.first[axis] + samples.count[axis] - 1) - bricks.first[axis] + 1);
  }
  return bricks;
}

// Room for all samples of some bricks, side by side.
template <int Dim>
glm::vec<Dim, int> room_for(const SampleRange<Dim>& bricks) {
  return bricks.count * CoarseStore<Dim>::kBrickSide;
}

// A part of a dense array of these bricks' samples.
template <int Dim>
SampleRows rows_of(const float* samples, const SampleRange<Dim>& bricks, const SampleRange<Dim>& part) {
  const glm::vec<Dim, int> count = room_for<Dim>(bricks);
  Index<Dim> start;
  for (int axis = 0; axis < Dim; ++axis) {
    start[axis] = part.first[axis] - CoarseStore<Dim>::first_sample(bricks.first[axis]);
  }
  SampleRows rows;
  rows.first = samples + offset_of<Dim>(start, count);
  rows.rows = static_cast<std::size_t>(part.count[Dim - 2]);
  rows.row_stride = static_cast<std::size_t>(count[Dim - 1]);
  if constexpr (Dim == 3) {
    rows.slabs = static_cast<std::size_t>(part.count[0]);
    rows.slab_stride = rows.row_stride * static_cast<std::size_t>(count[1]);
  }
  return rows;
}

}  // namespace

template <int Dim>
CoarseSamples<Dim>::CoarseSamples(CoarseStore<Dim>& store, const SampleRange<Dim>& range)
    : store_(store), bricks_(bricks_of<Dim>(range)) {
  double samples = Store::kBrickSamples;  // in double: may be huge
  for (int axis = 0; axis < Dim; ++axis) samples *= bricks_.count[axis];
  if (samples > static_cast<double>(kMostKept)) return;
  samples_ = std::make_unique_for_overwrite<float[]>(bricks_.size() * Store::kBrickSamples);
  fetched_.resize(bricks_.size(), false);
}

template <int Dim>
SampleRows CoarseSamples<Dim>::rows(const SampleRange<Dim>& part) {
  const SampleRange<Dim> needed = bricks_of<Dim>(part);
  const bool keep = samples_ != nullptr;
  if (!keep) passing_ = std::make_unique_for_overwrite<float[]>(needed.size() * Store::kBrickSamples);
  for_each_index<Dim>(needed.count, [&](const glm::vec<Dim, int>& index) {
    const Index<Dim> brick = needed.first + Index<Dim>(index);
    if (!keep) return fetch(brick, needed, passing_.get());
    const std::size_t number = offset_of<Dim>(brick - bricks_.first, bricks_.count);
    if (fetched_[number]) return;
    fetch(brick, bricks_, samples_.get());
    fetched_[number] = true;
  });
  return keep ? rows_of<Dim>(samples_.get(), bricks_, part) : rows_of<Dim>(passing_.get(), needed, part);
}

// Copies a brick to its place in the dense array of some.
template <int Dim>
void CoarseSamples<Dim>::fetch(const Index<Dim>& brick, const SampleRange<Dim>& bricks, float* samples) {
  const auto tile = store_.tile_of(brick);
  const float* from = tile->brick(brick).data();
  const glm::vec<Dim, int> count = room_for<Dim>(bricks);
  const Index<Dim> start = (brick - bricks.first) * std::int64_t{Store::kBrickSide};
  glm::vec<Dim, int> rows(Store::kBrickSide);
  rows[Dim - 1] = 1;
  for_each_index<Dim>(rows, [&](const glm::vec<Dim, int>& row) {
    std::copy_n(from, Store::kBrickSide, samples + offset_of<Dim>(start + Index<Dim>(row), count));
    from += Store::kBrickSide;
  });
}

template class CoarseSamples<2>;
template class CoarseSamples<3>;

}  // namespace solidnoise
