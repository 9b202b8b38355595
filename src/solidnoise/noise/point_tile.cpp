#include "solidnoise/noise/point_tile.h"

namespace solidnoise {
namespace {

// With m the mean normal, an impulse at X within the layer of a point x of normal n has
//   |m.(X - x)| <= |n.(X - x)| + |m - n| |X - x| <= layer + |m - n| reach.
template <int Dim>
void bound_layer(std::span<const LocatedPoint<Dim>> points, const Index<Dim>& anchor, float layer,
                 PointCull& cull) {
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
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      along += cull.normal[a] * from_anchor<Dim>(point, anchor, axis);
      const float difference = cull.normal[a] - point.normal[a];
      square += difference * difference;
    }
    const float half = point.radius * layer + std::sqrt(square) * cull.reach;
    cull.below = std::min(cull.below, along - half - kMargin);
    cull.above = std::max(cull.above, along + half + kMargin);
  }
}

}  // namespace

CellRange::CellRange(const PointCull& cull, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  first = static_cast<int>(std::floor(cull.lower[a] - cull.reach));
  count = std::min(static_cast<int>(std::floor(cull.upper[a] + cull.reach)) - first + 1, kMost);
  for (int i = 0; i < count; ++i) {
    const auto lower = static_cast<float>(first + i);
    const float excess = std::max({lower - cull.upper[a], cull.lower[a] - lower - 1.0f, 0.0f});
    square[static_cast<std::size_t>(i)] = excess * excess;
    along[static_cast<std::size_t>(i)] = axis < 3 ? cull.normal[a] * (lower + 0.5f) : 0.0f;
  }
}

template <int Dim>
std::size_t tile_size(std::span<const LocatedPoint<Dim>> points) {
  Index<Dim> lower = points.front().cell;
  Index<Dim> upper = lower;
  std::size_t count = 1;
  for (; count < std::min(points.size(), kTilePoints); ++count) {
    for (int axis = 0; axis < Dim; ++axis) {
      lower[axis] = std::min(lower[axis], points[count].cell[axis]);
      upper[axis] = std::max(upper[axis], points[count].cell[axis]);
      if (upper[axis] - lower[axis] >= kTileCells) return count;
    }
  }
  return count;
}

template <int Dim>
PointCull bounds(std::span<const LocatedPoint<Dim>> points, const Index<Dim>& anchor,
                 const KernelExtent& extent) {
  PointCull cull;
  cull.dimensions = Dim;
  cull.lower.fill(HUGE_VALF);
  cull.upper.fill(-HUGE_VALF);
  float largest = 0.0f;
  float least_density = HUGE_VALF;
  float most_density = 0.0f;
  for (const auto& point : points) {
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const float x = from_anchor<Dim>(point, anchor, axis);
      cull.lower[a] = std::min(cull.lower[a], x);
      cull.upper[a] = std::max(cull.upper[a], x);
    }
    largest = std::max(largest, point.radius);
    least_density = std::min(least_density, point.density);
    most_density = std::max(most_density, point.density);
  }
  cull.reach = largest * static_cast<float>(extent.reach());
  if (extent.fade) {
    // fade(y) is 0 outside of 2^-n < y < 1; a small margin for rounding.
    cull.least_turn = 0.9999f / static_cast<float>(1 << Dim) / most_density;
    cull.most_turn = 1.0001f / least_density;
  }
  if constexpr (Dim == 3) {
    if (extent.layer > 0.0) bound_layer<Dim>(points, anchor, static_cast<float>(extent.layer), cull);
  }
  return cull;
}

template std::size_t tile_size(std::span<const LocatedPoint<2>>);
template std::size_t tile_size(std::span<const LocatedPoint<3>>);
template std::size_t tile_size(std::span<const LocatedPoint<4>>);
template PointCull bounds(std::span<const LocatedPoint<2>>, const Index<2>&, const KernelExtent&);
template PointCull bounds(std::span<const LocatedPoint<3>>, const Index<3>&, const KernelExtent&);
template PointCull bounds(std::span<const LocatedPoint<4>>, const Index<4>&, const KernelExtent&);

}  // namespace solidnoise
