#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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

// Samples of a noise on a lattice that are evaluated when they are first asked for, in bricks, and kept.
template <int Dim>
class CoarseSamples {
 public:
  // All samples that are asked for must lie in the range. `lattice` gives origin and step.
  CoarseSamples(std::shared_ptr<const Noise<Dim>> noise, const Lattice<Dim>& lattice,
                const SampleRange<Dim>& range);

  // The samples of a part of the range, until the next call.
  SampleRows rows(const SampleRange<Dim>& part);

 private:
  static constexpr int kSide = 8;  // of a brick

  SampleRows rows_of(const std::vector<float>& samples, const glm::vec<Dim, int>& count,
                     const glm::vec<Dim, int>& start, const glm::vec<Dim, int>& part) const;
  Lattice<Dim> lattice_of(const SampleRange<Dim>& part) const;
  void evaluate_brick(const glm::vec<Dim, int>& brick);

  std::shared_ptr<const Noise<Dim>> noise_;
  Lattice<Dim> lattice_;
  SampleRange<Dim> range_;
  glm::vec<Dim, int> bricks_{1};
  std::unique_ptr<NoiseBlock<Dim>> block_;
  std::vector<float> passing_;   // of the last part, where the range is too much to keep
  std::vector<float> samples_;   // of the whole range; empty where that is too much to keep
  std::vector<bool> evaluated_;  // per brick
};

extern template class CoarseSamples<2>;
extern template class CoarseSamples<3>;

}  // namespace solidnoise
