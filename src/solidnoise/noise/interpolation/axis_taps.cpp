#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "solidnoise/noise/interpolation/interpolate_axis.h"

namespace solidnoise {
namespace {

int copied_tap(std::span<const float> weights) {
  const auto one = std::find(weights.begin(), weights.end(), 1.0f);
  const auto zeros = std::count(weights.begin(), weights.end(), 0.0f);
  const bool copied = one != weights.end() && zeros + 1 == std::ssize(weights);
  return copied ? static_cast<int>(one - weights.begin()) : -1;
}

}  // namespace

AxisTaps::AxisTaps(int taps, std::vector<std::size_t> first, std::vector<float> weight)
    : taps_(taps), first_(std::move(first)), weight_(std::move(weight)) {
  const auto width = static_cast<std::size_t>(taps);
  for (std::size_t i = 0; i < count(); ++i) copied_.push_back(copied_tap({weights(i), width}));
  for (std::size_t begin = 0; begin < count(); begin += Tile::kSide) {
    Tile tile{begin, std::min(Tile::kSide, count() - begin), first_[begin], {}};
    tile.columns.resize(first_[begin + tile.count - 1] + width - tile.first);
    for (std::size_t i = 0; i < tile.count; ++i) {
      for (std::size_t t = 0; t < width; ++t) {
        tile.columns[first_[begin + i] + t - tile.first][i] = weights(begin + i)[t];
      }
    }
    tiles_.push_back(std::move(tile));
  }
}

}  // namespace solidnoise
