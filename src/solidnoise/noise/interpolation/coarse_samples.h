#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solidnoise/noise/interpolation/coarse_store.h"
#include "solidnoise/noise/interpolation/interpolate_axis.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

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

  void fetch(const Index<Dim>& brick, const SampleRange<Dim>& bricks, std::vector<float>& samples);

  Store& store_;
  SampleRange<Dim> bricks_;
  std::vector<float> passing_;  // of the last part, where the range is too much to keep
  std::vector<float> samples_;  // of all bricks; empty where that is too much to keep
  std::vector<bool> fetched_;   // per brick
};

extern template class CoarseSamples<2>;
extern template class CoarseSamples<3>;

}  // namespace solidnoise
