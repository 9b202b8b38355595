#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "solidnoise/noise/interpolation/interpolate_axis.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Samples of a noise on a lattice, evaluated when they are first asked for and shared by all blocks: next to
// each other, blocks need the same samples. May be used by several threads at a time. Samples come in bricks,
// and bricks in tiles, which share random impulses; of the tiles, those used last are kept.
template <int Dim>
class CoarseStore {
 public:
  static constexpr int kBrickSide = Dim == 2 ? 32 : 8;             // samples
  static constexpr int kTileBricks = 4;                            // along an axis
  static constexpr std::size_t kMostBytes = std::size_t{1} << 26;  // of the samples that are kept

  static constexpr std::size_t power(int side) {
    std::size_t product = 1;
    for (int axis = 0; axis < Dim; ++axis) product *= static_cast<std::size_t>(side);
    return product;
  }
  static constexpr std::size_t kBrickSamples = power(kBrickSide);

  // The brick that holds a sample, and a brick's first sample, along any axis. Bricks begin a little before
  // multiples of their side, where blocks of voxels begin, for the sake of what interpolation needs there.
  static std::int64_t brick_of(std::int64_t sample);
  static std::int64_t first_sample(std::int64_t brick) { return brick * kBrickSide - kBefore; }

  // Some bricks in a cube. Keeps its samples while any block refers to it.
  class Tile {
   public:
    Tile(const CoarseStore& store, const Index<Dim>& first_brick);

    // Samples of the brick, the last axis fastest, evaluated if they are not yet.
    std::span<const float> brick(const Index<Dim>& brick);

   private:
    const CoarseStore& store_;
    const Index<Dim> first_brick_;
    std::mutex mutex_;
    std::unique_ptr<FieldBlock<Dim>> block_;  // until all bricks are evaluated
    std::size_t missing_ = power(kTileBricks);
    std::vector<bool> evaluated_;       // per brick
    std::unique_ptr<float[]> samples_;  // brick by brick
  };

  // `lattice` gives origin and step.
  CoarseStore(std::shared_ptr<const Noise<Dim>> noise, const Lattice<Dim>& lattice);

  // The tile that holds a brick. The store must outlive it.
  std::shared_ptr<Tile> tile_of(const Index<Dim>& brick);

 private:
  static constexpr int kBefore = 3;  // samples: what interpolation from eight needs before the first

  using Place = std::array<std::int64_t, Dim>;  // of a tile, in tiles
  using Recent = std::list<std::pair<Place, std::shared_ptr<Tile>>>;

  Lattice<Dim> lattice_of(const Index<Dim>& first_brick, int bricks) const;

  std::shared_ptr<const Noise<Dim>> noise_;
  Lattice<Dim> lattice_;
  std::mutex mutex_;
  Recent recent_;  // the tile used last comes first
  std::map<Place, typename Recent::iterator> tiles_;
};

// A box of samples of a lattice, by their indices.
template <int Dim>
struct SampleRange {
  Index<Dim> first{0};
  glm::vec<Dim, int> count{1};

  std::size_t size() const {
    std::size_t samples = 1;
    for (int axis = 0; axis < Dim; ++axis) samples *= static_cast<std::size_t>(count[axis]);
    return samples;
  }
};

// What one block needs of a store of coarse samples, side by side. Bricks are fetched when they are first
// asked for, and kept.
template <int Dim>
class CoarseSamples {
 public:
  // All samples that are asked for must lie in the range. The store must outlive this.
  CoarseSamples(CoarseStore<Dim>& store, const SampleRange<Dim>& range);

  // The samples of a part of the range, until the next call.
  SampleRows rows(const SampleRange<Dim>& part);

 private:
  using Store = CoarseStore<Dim>;

  void fetch(const Index<Dim>& brick, const SampleRange<Dim>& bricks, float* samples);

  Store& store_;
  SampleRange<Dim> bricks_;
  // Memory that is not touched before bricks are fetched into it.
  std::unique_ptr<float[]> passing_;  // of the last part, where the range is too much to keep
  std::unique_ptr<float[]> samples_;  // of all bricks; none where that is too much to keep
  std::vector<bool> fetched_;         // per brick
};

}  // namespace solidnoise
