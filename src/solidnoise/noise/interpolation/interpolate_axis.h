#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace solidnoise {

// How the samples of one axis come from coarser ones:
//   out[i] = sum over t of weight[i * taps + t] in[first[i] + t].
class AxisTaps {
 public:
  // `first` ascending; `taps` weights per sample out.
  AxisTaps(int taps, std::vector<std::size_t> first, std::vector<float> weight);

  int taps() const { return taps_; }
  std::size_t count() const { return first_.size(); }  // samples out
  std::size_t first(std::size_t i) const { return first_[i]; }
  // Which of its taps a sample is equal to; -1 where it is a sum.
  int copied(std::size_t i) const { return copied_[i]; }
  const float* weights(std::size_t i) const { return weight_.data() + i * static_cast<std::size_t>(taps_); }

  // Some consecutive samples out as a product of a matrix, a column for each coarse sample that any of them
  // needs, with these. A weight of 0 adds nothing, whatever it is multiplied by.
  struct Tile {
    static constexpr std::size_t kSide = 8;

    std::size_t begin = 0;  // sample out
    std::size_t count = 0;
    std::size_t first = 0;  // coarse sample
    std::vector<std::array<float, kSide>> columns;
  };
  const std::vector<Tile>& tiles() const { return tiles_; }

 private:
  int taps_;
  std::vector<std::size_t> first_;
  std::vector<float> weight_;
  std::vector<int> copied_;
  std::vector<Tile> tiles_;
};

// Rows of samples along the last axis, in slabs of some rows each; strides from one to the next.
struct SampleRows {
  const float* first = nullptr;
  std::size_t slabs = 1;
  std::size_t rows = 1;
  std::size_t slab_stride = 0;
  std::size_t row_stride = 0;
};

// The shape of a dense array around another axis: `outer` arrays of `in` rows of `inner` contiguous values
// each.
struct AxisShape {
  std::size_t outer = 1;
  std::size_t in = 1;
  std::size_t inner = 1;
};

// Interpolates an array along one axis; what comes out is dense. Sums are taken tap by tap, elementwise per
// sample, with explicit multiply-adds: a value does not depend on the vector width or on the other samples.
// Runs the code of the widest instruction set that the processor has.
void interpolate_last_axis(const AxisTaps& axis, const SampleRows& rows, float* out);
void interpolate_axis(const AxisTaps& axis, const AxisShape& shape, const float* in, float* out);

}  // namespace solidnoise
