#pragma once

#include <array>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/convolution/sparse_convolution.h"

namespace solidnoise {

// What the evaluators of sparse convolution share: impulses and their attributes.
template <int Dim>
struct SparseConvolution<Dim>::Source {
  Source(const ImpulseProcess<Dim>& process, const ImpulseKernel& kernel,
         const typename ImpulseBlock<Dim>::Reach& reach)
      : impulses(process, reach) {
    for (int channel = 0; channel < kernel.attribute_count(); ++channel) {
      attributes[channel].resize(impulses.size() + ImpulseList::kPadding);
    }
    kernel.draw(impulses.marks(), attributes);
  }

  ImpulseBlock<Dim> impulses;
  ImpulseAttributes attributes;
};

// Where the samples of a brick or cluster are: the anchor cell, the cells they lie in, and their bounds per
// role in cells from the anchor.
template <int Dim>
struct SparseConvolution<Dim>::Neighborhood {
  Index<Dim> first{0};  // the anchor
  Index<Dim> last{0};
  std::array<float, kRoles> lower{};
  std::array<float, kRoles> upper{};
};

// Exact position of `position` relative to the corner of cell `anchor`, in cells.
inline float from_anchor(const CellPosition& position, std::int64_t anchor) {
  return static_cast<float>(position.cell - anchor) + position.fraction;
}

}  // namespace solidnoise
