#include "solidnoise/noise/interpolation/coarse_store.h"

#include <utility>

#include "solidnoise/noise/interpolation/divide_down.h"

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
  if (samples_.empty()) samples_.resize(power(kTileBricks) * kBrickSamples);
  const std::span<float> samples = std::span(samples_).subspan(number * kBrickSamples, kBrickSamples);
  if (evaluated_[number]) return samples;
  if (!block_) block_ = store_.noise_->block(store_.lattice_of(first_brick_, kTileBricks).bounds());
  block_->evaluate(store_.lattice_of(brick, 1), Samples<Dim>{samples, {}});
  evaluated_[number] = true;
  if (--missing_ == 0) block_.reset();
  return samples;
}

template class CoarseStore<2>;
template class CoarseStore<3>;

}  // namespace solidnoise
