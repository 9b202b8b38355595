#include "solidnoise/mesh/smoothing_level.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// The cotangent of the angle at c, up to the largest that makes sense for a sliver.
double cotangent(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
  constexpr double kLargest = 100.0;
  const double cosine = glm::dot(a - c, b - c);
  const double sine = glm::length(glm::cross(a - c, b - c));
  return sine > 0.0 ? std::clamp(cosine / sine, -kLargest, kLargest) : std::copysign(kLargest, cosine);
}

std::vector<float> cotangent_weights(const SurfaceMesh& surface) {
  const Adjacency& neighbours = surface.neighbours();
  std::vector<float> all(neighbours.items.size(), 0.0f);
  const auto& positions = surface.positions();
  tbb::parallel_for(std::size_t{0}, surface.point_count(), [&](std::size_t p) {
    const auto around = neighbours[p];
    float* const weights = all.data() + neighbours.starts[p];
    for (const std::uint32_t t : surface.triangles_at(p)) {
      for (int corner = 0; corner < 3; ++corner) {
        const Triangle& triangle = surface.triangles()[t];
        const std::uint32_t q = triangle[static_cast<std::size_t>(corner)];
        if (q == p) continue;
        const std::uint32_t r = triangle[0] + triangle[1] + triangle[2] - q - static_cast<std::uint32_t>(p);
        const auto entry = std::lower_bound(around.begin(), around.end(), q) - around.begin();
        weights[entry] += static_cast<float>(0.5 * cotangent(positions[p], positions[q], positions[r]));
      }
    }
    for (std::size_t k = 0; k < around.size(); ++k) weights[k] = std::max(weights[k], 0.0f);
  });
  return all;
}

// The turns between neighbours, and the mean of their distances.
void measure_edges(SmoothingLevel& level) {
  const TangentFrames frames(level.normals);
  level.turns.resize(level.neighbours.items.size());
  tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t p) {
    const TangentFrame frame = frames[p];
    for (std::size_t k = level.neighbours.starts[p]; k < level.neighbours.starts[p + 1]; ++k) {
      const std::uint32_t q = level.neighbours.items[k];
      level.turns[k] = std::complex<float>(line_at(transport(frames[q], frame)));
    }
  });
  double sum = 0.0;
  for (std::size_t p = 0; p < level.size(); ++p) {
    for (const std::uint32_t q : level.neighbours[p])
      sum += glm::distance(level.positions[p], level.positions[q]);
  }
  const std::size_t count = level.neighbours.items.size();
  level.mean_edge = count > 0 ? sum / static_cast<double>(count) : 0.0;
}

// Greedily, in the order of the places; returns the clusters' first places.
std::vector<std::uint32_t> make_clusters(const SmoothingLevel& fine, std::vector<std::uint32_t>& cluster_of) {
  std::vector<std::uint32_t> seeds;
  cluster_of.assign(fine.size(), kNone);
  const auto is_free = [&](std::uint32_t q) { return cluster_of[q] == kNone; };
  for (std::size_t p = 0; p < fine.size(); ++p) {
    const auto around = fine.neighbours[p];
    if (!is_free(static_cast<std::uint32_t>(p)) || !std::all_of(around.begin(), around.end(), is_free))
      continue;
    const auto cluster = static_cast<std::uint32_t>(seeds.size());
    seeds.push_back(static_cast<std::uint32_t>(p));
    cluster_of[p] = cluster;
    for (const std::uint32_t q : around) cluster_of[q] = cluster;
  }
  // What is left has a neighbour in a cluster, and joins the nearest such.
  std::vector<std::uint32_t> joined = cluster_of;
  tbb::parallel_for(std::size_t{0}, fine.size(), [&](std::size_t p) {
    if (cluster_of[p] != kNone) return;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t q : fine.neighbours[p]) {
      const double distance = glm::distance(fine.positions[p], fine.positions[q]);
      if (cluster_of[q] == kNone || distance >= nearest) continue;
      nearest = distance;
      joined[p] = cluster_of[q];
    }
  });
  cluster_of = std::move(joined);
  return seeds;
}

}  // namespace

SmoothingLevel level_of_points(const SurfaceMesh& surface) {
  SmoothingLevel level;
  level.neighbours = surface.neighbours();
  level.areas = surface.areas();
  level.positions = surface.positions();
  level.normals = surface.normals();
  level.weights = cotangent_weights(surface);
  measure_edges(level);
  return level;
}

CoarserLevel make_coarser(const SmoothingLevel& fine) {
  CoarserLevel result;
  SmoothingLevel& coarse = result.level;
  const std::vector<std::uint32_t> seeds = make_clusters(fine, result.cluster_of);
  coarse.areas.assign(seeds.size(), 0.0);
  coarse.positions.assign(seeds.size(), Vec<3>(0.0));
  for (const std::uint32_t seed : seeds) coarse.normals.push_back(fine.normals[seed]);
  std::vector<std::uint32_t> counts(seeds.size(), 0);
  std::vector<std::vector<std::pair<std::uint32_t, Vec<3>>>> borders(seeds.size());
  for (std::size_t p = 0; p < fine.size(); ++p) {
    const std::uint32_t cluster = result.cluster_of[p];
    coarse.areas[cluster] += fine.areas[p];
    coarse.positions[cluster] += fine.positions[p];
    ++counts[cluster];
    for (std::size_t k = fine.neighbours.starts[p]; k < fine.neighbours.starts[p + 1]; ++k) {
      const std::uint32_t q = fine.neighbours.items[k];
      const std::uint32_t other = result.cluster_of[q];
      // A normal of the border between the two places, of its length.
      if (other != cluster) {
        borders[cluster].emplace_back(
            other, static_cast<double>(fine.weights[k]) * (fine.positions[q] - fine.positions[p]));
      }
    }
  }
  for (std::size_t c = 0; c < seeds.size(); ++c) coarse.positions[c] /= counts[c];

  for (std::size_t c = 0; c < seeds.size(); ++c) {
    auto& all = borders[c];
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < all.size();) {
      const std::uint32_t other = all[i].first;
      Vec<3> border(0.0);
      for (; i < all.size() && all[i].first == other; ++i) border += all[i].second;
      // What flows through it if the value is linear from centre to centre.
      const Vec<3> way = coarse.positions[other] - coarse.positions[c];
      const double square = glm::dot(way, way);
      const double flow = square > 0.0 ? glm::dot(border, way) / square : 0.0;
      coarse.neighbours.items.push_back(other);
      coarse.weights.push_back(static_cast<float>(std::max(flow, 0.0)));
    }
    coarse.neighbours.starts.push_back(static_cast<std::uint32_t>(coarse.neighbours.items.size()));
    all = {};
  }
  measure_edges(coarse);

  const TangentFrames frames(fine.normals);
  result.turns.resize(fine.size());
  tbb::parallel_for(std::size_t{0}, fine.size(), [&](std::size_t p) {
    const TangentFrame of_cluster = frames[seeds[result.cluster_of[p]]];
    result.turns[p] = std::complex<float>(line_at(transport(of_cluster, frames[p])));
  });
  return result;
}

}  // namespace solidnoise
