#pragma once

#include <algorithm>
#include <array>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/noise/convolution/impulse_block.h"
#include "solidnoise/noise/convolution/sparse_convolution.h"

namespace solidnoise {

// What the evaluators of sparse convolution share: impulses and their attributes.
template <int Dim>
struct SparseConvolution<Dim>::Source {
  Source(const ImpulseProcess<Dim>& process, const ImpulseKernel& kernel, const ImpulseReach<Dim>& reach)
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
struct SparseConvolution<Dim>::Neighbourhood {
  Index<Dim> first{0};  // the anchor
  Index<Dim> last{0};
  std::array<float, kRoles> lower{};
  std::array<float, kRoles> upper{};

  // Takes in a position along an axis, from the anchor.
  void include(Role role, float coordinate) {
    lower[role] = std::min(lower[role], coordinate);
    upper[role] = std::max(upper[role], coordinate);
  }
};

// Where the impulses are that reach it.
template <int Dim>
ImpulseReach<Dim> SparseConvolution<Dim>::reach_of(const Neighbourhood& neighbourhood) const {
  constexpr float kSlack = 1e-6f;  // of the cells: what single precision may lose of a place among them
  ImpulseReach<Dim> reach{neighbourhood.first - reach_, neighbourhood.last + reach_};
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Role role = role_of_axis<Dim>(axis);
    const float slack = kSlack * static_cast<float>(reach.last[axis] - reach.first[axis]);
    reach.lower[a] = static_cast<float>(reach_[axis]) + neighbourhood.lower[role] - slack;
    reach.upper[a] = static_cast<float>(reach_[axis]) + neighbourhood.upper[role] + slack;
    reach.scale[a] = scale_[role];
  }
  reach.is_ball = kernel_->support() == CullBox::Support::ball;
  return reach;
}

// Exact position of `position` relative to the corner of cell `anchor`, in cells.
inline float from_anchor(const CellPosition& position, std::int64_t anchor) {
  return static_cast<float>(position.cell - anchor) + position.fraction;
}

}  // namespace solidnoise
