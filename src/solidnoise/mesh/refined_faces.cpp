#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "solidnoise/mesh/cut_triangle.h"

namespace solidnoise {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct SplitCorner {
  Vec<3> position;
  double target = 0.0;
};

bool is_too_long(const SplitCorner& a, const SplitCorner& b) {
  return glm::distance(a.position, b.position) > std::min(a.target, b.target);
}

// Counts the parts of a triangle in the order that they are cut, up to a number.
class PartCount {
 public:
  explicit PartCount(double most) : most_(most) {}

  // Infinity if there are more.
  double of(const std::array<SplitCorner, 3>& triangle) {
    parts_ = 0.0;
    cut(triangle, 0);
    return parts_ > most_ ? kInfinite : parts_;
  }

 private:
  void cut(const std::array<SplitCorner, 3>& triangle, int depth) {
    // Deeper, edges are too short for their ends' coordinates to differ.
    constexpr int kDeepest = 200;
    if (depth > kDeepest) parts_ = kInfinite;
    if (parts_ > most_) return;
    std::array<SplitCorner, 6> corners{triangle[0], triangle[1], triangle[2]};
    std::array<std::uint32_t, 3> middles{kWhole, kWhole, kWhole};
    int split = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const SplitCorner& a = triangle[k];
      const SplitCorner& b = triangle[(k + 1) % 3];
      if (!is_too_long(a, b)) continue;
      corners[3 + k] = {0.5 * (a.position + b.position), 0.5 * (a.target + b.target)};
      middles[k] = 3 + k;
      ++split;
    }
    if (split == 0) {
      parts_ += 1.0;
      return;
    }
    const auto place = [&](std::uint32_t corner) -> const Vec<3>& { return corners[corner].position; };
    const auto parts = cut_triangle({0, 1, 2}, middles, place);
    for (int part = 0; part <= split; ++part) {
      const auto& [a, b, c] = parts[static_cast<std::size_t>(part)];
      cut({corners[a], corners[b], corners[c]}, depth + 1);
    }
  }

  double most_;
  double parts_ = 0.0;
};

// No fewer parts than these have: none is larger than an equilateral triangle whose sides are the longest
// target of its corners.
double fewest_parts(const PolygonMesh& mesh, const std::vector<double>& targets,
                    const std::vector<Triangle>& triangles) {
  const double kOfSquare = std::sqrt(3.0) / 4.0;
  double parts = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Vec<3>& corner = mesh.positions[a];
    const double area = 0.5 * glm::length(glm::cross(mesh.positions[b] - corner, mesh.positions[c] - corner));
    const double side = std::max({targets[a], targets[b], targets[c]});
    parts += std::max(1.0, area / (kOfSquare * side * side));
  }
  return parts;
}

double count_parts(const PolygonMesh& mesh, const std::vector<double>& targets, double most) {
  const std::vector<Triangle> triangles = triangulate(mesh);
  // Which spares counting what is far too much.
  if (fewest_parts(mesh, targets, triangles) > 1.001 * most) return kInfinite;
  std::atomic<std::uint64_t> faces{0};
  constexpr std::size_t kGrain = 256;
  constexpr double kMost = 1e15;  // far more than there is memory for
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), kGrain), [&](const auto& range) {
    const auto before = static_cast<double>(faces);
    if (before > most) return;
    PartCount count(most - before);
    double parts = 0.0;
    for (std::size_t t = range.begin(); t < range.end() && parts <= most; ++t) {
      const auto& [a, b, c] = triangles[t];
      const auto corner = [&](std::uint32_t v) { return SplitCorner{mesh.positions[v], targets[v]}; };
      parts += count.of({corner(a), corner(b), corner(c)});
    }
    faces += static_cast<std::uint64_t>(std::min(parts, kMost));
  });
  const auto counted = static_cast<double>(faces);
  return counted > most || counted >= kMost ? kInfinite : counted;
}

}  // namespace

double refined_faces(const PolygonMesh& mesh, const std::vector<double>& targets,
                     const RefineOptions& options, double most) {
  using enum RefineOptions::Method;
  if (options.method == own || options.method == longest_edge) return count_parts(mesh, targets, most);
  const double parts = options.method == sqrt3 ? 3.0 : 4.0;
  const double faces = static_cast<double>(mesh.face_count()) *
                       std::pow(parts, openmesh_rounds(mesh, targets, options.method));
  return faces > most ? kInfinite : faces;
}

}  // namespace solidnoise
