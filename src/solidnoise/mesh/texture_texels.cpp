#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/mesh/texture_plan.h"

namespace solidnoise {
namespace {

constexpr double kReach = 1.5;  // texels: what linear interpolation at an island's edge asks for
constexpr int kBand = 32;       // rows that are filled together

// A triangle in texels, whose centres are at whole numbers, y downwards.
struct PlacedTriangle {
  std::array<Vec<2>, 3> corners;

  PlacedTriangle(const TextureTriangle& triangle, const Vec<2>& tile, double size) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec<2> in_tile = triangle.places[i] - tile;
      corners[i] = Vec<2>(in_tile.x, 1.0 - in_tile.y) * size - 0.5;
    }
  }

  Vec<3> weights(const Vec<2>& point) const {
    const auto& [a, b, c] = corners;
    const auto cross = [](const Vec<2>& p, const Vec<2>& q) { return p.x * q.y - p.y * q.x; };
    const double area = cross(b - a, c - a);
    const double of_b = cross(point - a, c - a) / area;
    const double of_c = cross(b - a, point - a) / area;
    return {1.0 - of_b - of_c, of_b, of_c};
  }

  // To the nearest point of the edges.
  double distance(const Vec<2>& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec<2> edge = corners[(i + 1) % 3] - corners[i];
      const Vec<2> from = point - corners[i];
      const double length = glm::dot(edge, edge);
      const double along = length > 0.0 ? std::clamp(glm::dot(from, edge) / length, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, glm::length(from - along * edge));
    }
    return nearest;
  }
};

// The nearest triangle of each texel of some rows: inside one, the first that it is in.
class RowBand {
 public:
  RowBand(const TexturePlan& plan, const TextureTile& tile, int first, int end)
      : plan_(plan), tile_(tile), size_(plan.options.size), first_(first), end_(end) {
    const auto count = static_cast<std::size_t>(end - first) * static_cast<std::size_t>(size_);
    distances_.assign(count, std::numeric_limits<float>::infinity());
    texels_.resize(count);
  }

  TileTexels fill() {
    for (const std::uint32_t triangle : tile_.triangles) add(triangle);
    TileTexels found;
    found.overlapped = overlapped_;
    for (std::size_t i = 0; i < texels_.size(); ++i) {
      if (std::isinf(distances_[i])) continue;
      texels_[i].index =
          static_cast<std::uint32_t>(static_cast<std::size_t>(first_) * static_cast<std::size_t>(size_) + i);
      found.texels.push_back(texels_[i]);
    }
    return found;
  }

 private:
  static constexpr float kInside = -1.0f;  // farther inside than rounding

  void add(std::uint32_t index) {
    const PlacedTriangle placed(plan_.triangles[index], plan_.corner_of(tile_), size_);
    const auto& [a, b, c] = placed.corners;
    const auto first = [](double least, int lowest) {
      return std::max(lowest, static_cast<int>(std::ceil(std::max(least - kReach, -1.0))));
    };
    const auto last = [](double most, int highest) {
      return std::min(highest - 1, static_cast<int>(std::floor(std::min(most + kReach, 1e6))));
    };
    const int top = first(std::min({a.y, b.y, c.y}), first_);
    const int bottom = last(std::max({a.y, b.y, c.y}), end_);
    const int left = first(std::min({a.x, b.x, c.x}), 0);
    const int right = last(std::max({a.x, b.x, c.x}), size_);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) add_at(index, placed, x, y);
    }
  }

  void add_at(std::uint32_t index, const PlacedTriangle& placed, int x, int y) {
    constexpr double kMargin = 1e-6;
    const Vec<2> point(x, y);
    const Vec<3> weights = placed.weights(point);
    const double least = std::min({weights.x, weights.y, weights.z});
    double distance = kInside;
    if (least < kMargin) distance = least >= 0.0 ? 0.0 : placed.distance(point);
    if (distance > kReach) return;
    const auto i =
        static_cast<std::size_t>(y - first_) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
    if (distance == kInside && distances_[i] == kInside) ++overlapped_;
    if (!(static_cast<float>(distance) < distances_[i])) return;
    distances_[i] = static_cast<float>(distance);
    texels_[i] = {0, index};
  }

  const TexturePlan& plan_;
  const TextureTile& tile_;
  int size_;
  int first_;
  int end_;
  std::vector<float> distances_;
  std::vector<Texel> texels_;
  std::size_t overlapped_ = 0;
};

}  // namespace

TileTexels find_texels(const TexturePlan& plan, const TextureTile& tile) {
  const int bands = (plan.options.size + kBand - 1) / kBand;
  std::vector<TileTexels> found(static_cast<std::size_t>(bands));
  tbb::parallel_for(0, bands, [&](int i) {
    const int first = i * kBand;
    const int end = std::min(first + kBand, plan.options.size);
    found[static_cast<std::size_t>(i)] = RowBand(plan, tile, first, end).fill();
  });
  TileTexels all;
  for (const TileTexels& band : found) {
    all.texels.insert(all.texels.end(), band.texels.begin(), band.texels.end());
    all.overlapped += band.overlapped;
  }
  return all;
}

Vec<3> weights_at(const TexturePlan& plan, const TextureTile& tile, const Texel& texel) {
  const auto size = static_cast<std::uint32_t>(plan.options.size);
  return PlacedTriangle(plan.triangles[texel.triangle], plan.corner_of(tile), plan.options.size)
      .weights({texel.index % size, texel.index / size});
}

}  // namespace solidnoise
