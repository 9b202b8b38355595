#include "solidnoise/core/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "solidnoise/core/bounds.h"

namespace solidnoise {
namespace {

// The first `bits` bits of a number, with Dim - 1 zeros between each two.
template <int Dim>
std::uint64_t spread(std::uint64_t number, int bits) {
  std::uint64_t result = 0;
  for (int bit = 0; bit < bits; ++bit) result |= (number >> bit & 1u) << (Dim * bit);
  return result;
}

// The same, eight bits at a time.
template <int Dim>
class Spreader {
 public:
  Spreader() {
    for (std::size_t byte = 0; byte < bytes_.size(); ++byte) bytes_[byte] = spread<Dim>(byte, 8);
  }
  std::uint64_t operator()(std::uint64_t number) const {
    return bytes_[number & 255u] | bytes_[number >> 8 & 255u] << (8 * Dim);
  }

 private:
  std::array<std::uint64_t, 256> bytes_;
};

}  // namespace

void sort_by_key(std::vector<KeyedPoint>& points, int bits) {
  constexpr std::size_t kWorthRadixSort = 2000;
  if (points.size() <= kWorthRadixSort) {
    std::stable_sort(points.begin(), points.end(),
                     [](const KeyedPoint& a, const KeyedPoint& b) { return a.key < b.key; });
    return;
  }
  constexpr int kDigit = 12;
  std::vector<KeyedPoint> other(points.size());
  std::vector<std::size_t> starts(std::size_t{1} << kDigit);
  for (int shift = 0; shift < bits; shift += kDigit) {
    const auto digit = [shift](const KeyedPoint& point) { return point.key >> shift & ((1u << kDigit) - 1); };
    std::fill(starts.begin(), starts.end(), 0);
    for (const KeyedPoint& point : points) ++starts[digit(point)];
    std::size_t next = 0;
    for (std::size_t& start : starts) next += std::exchange(start, next);
    for (const KeyedPoint& point : points) other[starts[digit(point)]++] = point;
    points.swap(other);
  }
}

template <int Dim>
std::vector<std::size_t> spatial_order(const Points<Dim>& points) {
  constexpr int kBits = Dim == 4 ? 12 : 16;
  constexpr double kMostScale = 1e300;
  static const Spreader<Dim> spreader;

  std::vector<KeyedPoint> keyed(points.size());
  const Box<Dim> box = bounds_of(points.positions);
  Vec<Dim> scale(0.0);
  for (int axis = 0; axis < Dim; ++axis) {
    const double extent = box.upper[axis] - box.lower[axis];
    if (extent > 0.0 && std::isfinite(extent))
      scale[axis] = std::min(((1 << kBits) - 1) / extent, kMostScale);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    keyed[i].point = i;
    for (int axis = 0; axis < Dim; ++axis) {
      const double place = (points.coordinate(i, axis) - box.lower[axis]) * scale[axis];
      keyed[i].key |= spreader(static_cast<std::uint64_t>(place)) << axis;
    }
  }
  sort_by_key(keyed, kBits * Dim);
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = keyed[i].point;
  return order;
}

template std::vector<std::size_t> spatial_order(const Points<2>&);
template std::vector<std::size_t> spatial_order(const Points<3>&);
template std::vector<std::size_t> spatial_order(const Points<4>&);

}  // namespace solidnoise
