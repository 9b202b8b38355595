#include "solidnoise/noise/point/point_tile.h"

#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace solidnoise {
namespace {

// With m the mean normal, an impulse at X within the layer of a point x of normal n has
//   |m.(X - x)| <= |n.(X - x)| + |m - n| |X - x| <= layer + |m - n| reach.
template <int Dim>
void bound_layer(std::span<const LocatedPoint<Dim>> points, PointCull& cull) {
  std::array<float, 3> mean{};
  for (const auto& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += point.normal[axis];
  }
  const float length = std::sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
  if (length < 0.5f * static_cast<float>(points.size())) return;  // too different to say anything
  for (std::size_t axis = 0; axis < 3; ++axis) cull.normal[axis] = mean[axis] / length;
  cull.below = HUGE_VALF;
  cull.above = -HUGE_VALF;
  constexpr float kMargin = 1e-4f;
  for (const auto& point : points) {
    float along = 0.0f;
    float square = 0.0f;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along += cull.normal[axis] * point.at[axis];
      const float difference = cull.normal[axis] - point.normal[axis];
      square += difference * difference;
    }
    const float half = point.height + std::sqrt(square) * cull.reach;
    cull.below = std::min(cull.below, along - half - kMargin);
    cull.above = std::max(cull.above, along + half + kMargin);
  }
}

}  // namespace

void refuse_point(const CellAxis& axis, double coordinate, std::size_t point) {
  throw std::invalid_argument(fmt::format(
      "position of point {} has a coordinate of {}; with the frequency there it must be within {:.6g}", point,
      coordinate, CellAxis::kMostCells * axis.size()));
}

CellRange::CellRange(const PointCull& cull, Role role) {
  const auto a = static_cast<std::size_t>(role);
  first = static_cast<int>(std::floor(cull.lower[a] - cull.reach - (cull.span - 1.0f)));
  count = std::min(static_cast<int>(std::floor(cull.upper[a] + cull.reach)) - first + 1, kMost);
  for (int i = 0; i < count; ++i) {
    const auto lower = static_cast<float>(first + i);
    const float excess = std::max({lower - cull.upper[a], cull.lower[a] - lower - cull.span, 0.0f});
    square[static_cast<std::size_t>(i)] = excess * excess;
    along[static_cast<std::size_t>(i)] = role != kT ? cull.normal[a] * (lower + 0.5f * cull.span) : 0.0f;
  }
}

std::pair<int, int> CellRange::between(float lower, float upper) const {
  const float step = count > 1 ? along[1] - along[0] : 0.0f;
  if (std::abs(step) < 1e-3f) {
    // All are about the same.
    const float margin = 1e-3f * static_cast<float>(count);
    return along[0] >= lower - margin && along[0] <= upper + margin ? std::pair(0, count - 1)
                                                                    : std::pair(0, -1);
  }
  const auto index = [&](float value) {
    return std::clamp((value - along[0]) / step, -1.0f, static_cast<float>(count));
  };
  const float first_index = index(step > 0.0f ? lower : upper);
  const float last_index = index(step > 0.0f ? upper : lower);
  return {std::max(0, static_cast<int>(std::floor(first_index))),
          std::min(count - 1, static_cast<int>(std::ceil(last_index)))};
}

template <int Dim>
PointTile<Dim>::PointTile(std::span<LocatedPoint<Dim>>& rest) : anchor(rest.front().cell) {
  // How many cells around points in a box of cells have impulses for them.
  const auto cells_around = [reach = 2.0f * rest.front().radius + 1.0f](const Index<Dim>& lower,
                                                                        const Index<Dim>& upper) {
    float product = 1.0f;
    for (int axis = 0; axis < Dim; ++axis) product *= static_cast<float>(upper[axis] - lower[axis]) + reach;
    return product;
  };
  Index<Dim> lower = anchor;
  Index<Dim> upper = anchor;
  float reach = 0.0f;
  const float single = cells_around(anchor, anchor);
  float all = single;
  std::size_t count = 0;
  for (; count < std::min(rest.size(), kTilePoints); ++count) {
    LocatedPoint<Dim>& point = rest[count];
    const Index<Dim> wider_lower = glm::min(lower, point.cell);
    const Index<Dim> wider_upper = glm::max(upper, point.cell);
    if (wider_lower != lower || wider_upper != upper) {
      bool near = true;
      for (int axis = 0; axis < Dim; ++axis) {
        const auto extent = static_cast<float>(wider_upper[axis] - wider_lower[axis]);
        near = near && extent + 1.0f + std::max(reach, point.radius) < kExactCells;
      }
      const float wider = near ? cells_around(wider_lower, wider_upper) : HUGE_VALF;
      if (wider > all + single) break;
      lower = wider_lower;
      upper = wider_upper;
      all = wider;
    }
    reach = std::max(reach, point.radius);
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      point.at[a] = static_cast<float>(point.cell[axis] - anchor[axis]) + point.fraction[a];
    }
  }
  points = rest.first(count);
  rest = rest.subspan(count);
}

template <int Dim>
PointCull bounds(std::span<const LocatedPoint<Dim>> points, const KernelExtent& extent) {
  PointCull cull;
  cull.dimensions = Dim;
  cull.lower.fill(HUGE_VALF);
  cull.upper.fill(-HUGE_VALF);
  float largest = 0.0f;
  float least_density = HUGE_VALF;
  float most_density = 0.0f;
  for (const auto& point : points) {
    for (int axis = 0; axis < Dim; ++axis) {
      const Role role = role_of_axis<Dim>(axis);
      const float at = point.at[static_cast<std::size_t>(axis)];
      cull.lower[role] = std::min(cull.lower[role], at);
      cull.upper[role] = std::max(cull.upper[role], at);
    }
    largest = std::max(largest, point.radius);
    least_density = std::min(least_density, point.density);
    most_density = std::max(most_density, point.density);
  }
  cull.reach = largest * extent.reach;
  cull.span = extent.span;
  if (extent.fade) {
    // fade(y) is 0 outside of 2^-n < y < 1; a small margin for rounding.
    cull.least_turn = 0.9999f / static_cast<float>(1 << Dim) / most_density;
    cull.most_turn = 1.0001f / least_density;
  }
  if constexpr (Dim == 3) {
    if (extent.layer > 0.0f) bound_layer<Dim>(points, cull);
  }
  return cull;
}

PointCull joined(const PointCull& a, const PointCull& b) {
  PointCull both = a;
  for (std::size_t axis = 0; axis < both.lower.size(); ++axis) {
    both.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    both.upper[axis] = std::max(a.upper[axis], b.upper[axis]);
  }
  both.reach = std::max(a.reach, b.reach);
  both.least_turn = std::min(a.least_turn, b.least_turn);
  both.most_turn = std::max(a.most_turn, b.most_turn);
  both.normal.fill(0.0f);
  both.below = both.above = 0.0f;
  return both;
}

PointCull coarsened(const PointCull& cull, const std::array<float, kRoles>& offset) {
  PointCull coarse = cull;
  float along = 0.0f;
  for (std::size_t role = 0; role < kRoles; ++role) {
    coarse.lower[role] = 0.5f * (cull.lower[role] + offset[role]);
    coarse.upper[role] = 0.5f * (cull.upper[role] + offset[role]);
    if (role != kT) along += cull.normal[role] * offset[role];
  }
  coarse.reach = 0.5f * cull.reach;
  coarse.below = 0.5f * (cull.below + along);
  coarse.above = 0.5f * (cull.above + along);
  return coarse;
}

template struct PointTile<3>;
template struct PointTile<4>;
template PointCull bounds(std::span<const LocatedPoint<3>>, const KernelExtent&);
template PointCull bounds(std::span<const LocatedPoint<4>>, const KernelExtent&);

}  // namespace solidnoise
