#include "solidnoise/mesh/surface_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/core/bounds.h"
#include "solidnoise/geometry/same_places.h"

namespace solidnoise {
namespace {

void check(const PolygonMesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec<3>& p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw std::invalid_argument(fmt::format("the position of vertex {} is not finite", v));
    }
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t vertex : mesh.face(f)) {
      if (vertex >= mesh.positions.size()) {
        throw std::invalid_argument(
            fmt::format("face {} names vertex {}; there are {} vertices", f, vertex, mesh.positions.size()));
      }
    }
  }
}

Adjacency triangles_around(const std::vector<Triangle>& triangles, std::size_t points) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  Adjacency around = places_of(corners, points);
  for (std::uint32_t& place : around.items) place /= 3;
  return around;
}

// The other corners of a triangle, in its order.
std::array<std::uint32_t, 2> others(const Triangle& triangle, std::uint32_t point) {
  const std::size_t corner = triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
  return {triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]};
}

// A triangle as seen from one of its corners.
struct Corner {
  Vec<3> a;  // to the next corner
  Vec<3> b;  // to the one after
  Vec<3> cross;
  double twice_area;

  double angle() const { return std::atan2(twice_area, glm::dot(a, b)); }

  // The part of the triangle nearer to this corner than to the others where no angle is obtuse; otherwise
  // half of the triangle goes to the obtuse corner and a quarter to the others.
  double mixed_area() const {
    if (!(twice_area > 0.0)) return 0.0;
    const double here = glm::dot(a, b);
    const double at_a = glm::dot(a, a - b);
    const double at_b = glm::dot(b, b - a);
    if (here < 0.0) return 0.25 * twice_area;
    if (at_a < 0.0 || at_b < 0.0) return 0.125 * twice_area;
    return 0.125 * (glm::dot(a, a) * at_b + glm::dot(b, b) * at_a) / twice_area;
  }
};

}  // namespace

SurfaceMesh::SurfaceMesh(const PolygonMesh& mesh) {
  check(mesh);
  positions_ = mesh.positions;
  point_of_.resize(positions_.size());
  std::iota(point_of_.begin(), point_of_.end(), 0u);
  first_vertex_ = point_of_;
  triangles_ = triangulate(mesh);
  join_points(first_at_position(positions_));
  connect();
  if (std::find(on_boundary_.begin(), on_boundary_.end(), 1) != on_boundary_.end()) {
    const std::size_t points = point_count();
    join_points(first_across_gap(positions_, seam_gaps()));
    if (point_count() < points) connect();
  }
  measure_points();
}

void SurfaceMesh::join_points(const std::vector<std::uint32_t>& first) {
  std::vector<std::uint32_t> joined(first.size());
  std::uint32_t count = 0;
  for (std::size_t p = 0; p < first.size(); ++p) {
    if (first[p] != p) {
      joined[p] = joined[first[p]];
      continue;
    }
    positions_[count] = positions_[p];
    first_vertex_[count] = first_vertex_[p];
    joined[p] = count++;
  }
  positions_.resize(count);
  first_vertex_.resize(count);
  for (std::uint32_t& point : point_of_) point = joined[point];
  for (Triangle& triangle : triangles_) {
    for (std::uint32_t& corner : triangle) corner = joined[corner];
  }
  std::erase_if(triangles_, [](const Triangle& triangle) {
    return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
  });
}

std::vector<double> SurfaceMesh::seam_gaps() const {
  const Box<3> box = bounds_of<3>(positions_);
  const Vec<3> sides = box.upper - box.lower;
  const double widest = std::max({sides.x, sides.y, sides.z});
  std::vector<double> gaps(point_count());
  tbb::parallel_for(std::size_t{0}, point_count(), [&](std::size_t point) {
    if (!on_boundary(point)) return;
    double longest = 0.0;
    for (const std::uint32_t other : neighbours(point))
      longest = std::max(longest, glm::distance(positions_[other], positions_[point]));
    gaps[point] = seam_gap(widest, longest);
  });
  return gaps;
}

void SurfaceMesh::drop_duplicates() {
  struct Key {
    std::uint32_t middle;
    std::uint32_t last;
    std::uint32_t triangle;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<char> duplicate(triangles_.size());
  // Each triangle is looked for at its smallest corner.
  tbb::parallel_for(std::size_t{0}, point_count(), [&](std::size_t point) {
    std::vector<Key> keys;
    for (const std::uint32_t t : triangles_at_[point]) {
      const auto [a, b] = others(triangles_[t], static_cast<std::uint32_t>(point));
      if (std::min(a, b) > point) keys.push_back({std::min(a, b), std::max(a, b), t});
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i].middle == keys[i - 1].middle && keys[i].last == keys[i - 1].last) {
        duplicate[keys[i].triangle] = 1;
      }
    }
  });
  if (std::find(duplicate.begin(), duplicate.end(), 1) == duplicate.end()) return;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (duplicate[t] == 0) triangles_[kept++] = triangles_[t];
  }
  triangles_.resize(kept);
  triangles_at_ = triangles_around(triangles_, point_count());
}

void SurfaceMesh::connect() {
  triangles_at_ = triangles_around(triangles_, point_count());
  drop_duplicates();
  // Each triangle brings two neighbours to each corner, each of them as often as their edge has triangles.
  const auto found = std::make_unique_for_overwrite<std::uint32_t[]>(2 * triangles_at_.items.size());
  std::vector<std::uint32_t> counts(point_count());
  on_boundary_.assign(point_count(), 0);
  tbb::parallel_for(std::size_t{0}, point_count(), [&](std::size_t point) {
    std::uint32_t* const begin = found.get() + 2 * std::size_t{triangles_at_.starts[point]};
    std::uint32_t* end = begin;
    for (const std::uint32_t t : triangles_at_[point]) {
      for (const std::uint32_t other : others(triangles_[t], static_cast<std::uint32_t>(point)))
        *end++ = other;
    }
    std::sort(begin, end);
    std::uint32_t* last = begin;
    for (std::uint32_t* run = begin; run != end;) {
      std::uint32_t* const next = std::upper_bound(run, end, *run);
      if (next - run == 1) on_boundary_[point] = 1;
      *last++ = *run;
      run = next;
    }
    counts[point] = static_cast<std::uint32_t>(last - begin);
  });
  neighbours_.starts.resize(point_count() + 1);
  std::partial_sum(counts.begin(), counts.end(), neighbours_.starts.begin() + 1);
  neighbours_.items.resize(neighbours_.starts.back());
  tbb::parallel_for(std::size_t{0}, point_count(), [&](std::size_t point) {
    std::copy_n(found.get() + 2 * std::size_t{triangles_at_.starts[point]}, counts[point],
                neighbours_.items.begin() + neighbours_.starts[point]);
  });
}

void SurfaceMesh::measure_points() {
  normals_.resize(point_count());
  areas_.assign(point_count(), 0.0);
  std::vector<double> lengths(point_count());
  tbb::parallel_for(std::size_t{0}, point_count(), [&](std::size_t point) {
    const Vec<3>& position = positions_[point];
    Vec<3> sum(0.0);
    double weights = 0.0;
    Corner largest{{}, {}, {0.0, 1.0, 0.0}, 0.0};
    for (const std::uint32_t t : triangles_at_[point]) {
      const auto [next, after] = others(triangles_[t], static_cast<std::uint32_t>(point));
      Corner corner{positions_[next] - position, positions_[after] - position, {}, 0.0};
      corner.cross = glm::cross(corner.a, corner.b);
      corner.twice_area = glm::length(corner.cross);
      const double angle = corner.angle();
      sum += angle * corner.cross;
      weights += angle * corner.twice_area;
      areas_[point] += corner.mixed_area();
      if (corner.twice_area > largest.twice_area) largest = corner;
    }
    constexpr double kCancelled = 1e-9;
    normals_[point] = glm::normalize(glm::length(sum) > kCancelled * weights ? sum : largest.cross);
    for (const std::uint32_t other : neighbours(point)) {
      if (other > point) lengths[point] += glm::length(positions_[other] - position);
    }
  });
  if (!neighbours_.items.empty()) {
    mean_edge_length_ = std::accumulate(lengths.begin(), lengths.end(), 0.0) /
                        (0.5 * static_cast<double>(neighbours_.items.size()));
  }
}

}  // namespace solidnoise
