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

std::vector<std::complex<float>> turns_between_points(const SurfaceMesh& surface,
                                                      std::span<const Vec<3>> normals) {
  const Adjacency& neighbours = surface.neighbours();
  const TangentFrames frames(normals);
  std::vector<std::complex<float>> turns(neighbours.items.size());
  tbb::parallel_for(std::size_t{0}, surface.point_count(), [&](std::size_t p) {
    const TangentFrame frame = frames[p];
    for (std::size_t k = neighbours.starts[p]; k < neighbours.starts[p + 1]; ++k) {
      turns[k] = std::complex<float>(line_at(transport(frames[neighbours.items[k]], frame)));
    }
  });
  return turns;
}

double mean_edge_of(const SmoothingLevel& level) {
  double sum = 0.0;
  for (std::size_t p = 0; p < level.size(); ++p) {
    for (const std::uint32_t q : level.neighbours[p])
      sum += glm::distance(level.positions[p], level.positions[q]);
  }
  const std::size_t count = level.neighbours.items.size();
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

// Neighbours between which much flows of what flows at either (Vanek et al. 1996): across long thin
// triangles, not along them.
class StrongNeighbours {
 public:
  explicit StrongNeighbours(const SmoothingLevel& level) : level_(level), flows_(level.size(), 0.0f) {
    tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t p) {
      for (std::size_t k = begin(p); k < end(p); ++k) flows_[p] += level.weights[k];
    });
  }

  std::size_t begin(std::size_t p) const { return level_.neighbours.starts[p]; }
  std::size_t end(std::size_t p) const { return level_.neighbours.starts[p + 1]; }
  std::uint32_t at(std::size_t k) const { return level_.neighbours.items[k]; }

  bool contains(std::size_t p, std::size_t k) const {
    constexpr float kLeast = 0.08f;
    return level_.weights[k] > kLeast * std::sqrt(flows_[p] * flows_[at(k)]);
  }

 private:
  const SmoothingLevel& level_;
  std::vector<float> flows_;
};

// Greedily, in the order of the places; returns the clusters' first places.
std::vector<std::uint32_t> make_clusters(const SmoothingLevel& fine, std::vector<std::uint32_t>& cluster_of) {
  std::vector<std::uint32_t> seeds;
  cluster_of.assign(fine.size(), kNone);
  const StrongNeighbours strong(fine);
  const auto is_taken = [&](std::size_t p, std::size_t k) {
    return strong.contains(p, k) && cluster_of[strong.at(k)] != kNone;
  };
  const auto any_is_taken = [&](std::size_t p) {
    for (std::size_t k = strong.begin(p); k < strong.end(p); ++k) {
      if (is_taken(p, k)) return true;
    }
    return false;
  };
  for (std::size_t p = 0; p < fine.size(); ++p) {
    if (cluster_of[p] != kNone || any_is_taken(p)) continue;
    const auto cluster = static_cast<std::uint32_t>(seeds.size());
    seeds.push_back(static_cast<std::uint32_t>(p));
    cluster_of[p] = cluster;
    for (std::size_t k = strong.begin(p); k < strong.end(p); ++k) {
      if (strong.contains(p, k)) cluster_of[strong.at(k)] = cluster;
    }
  }
  // What is left has a strong neighbour in a cluster, and joins the strongest such.
  std::vector<std::uint32_t> joined = cluster_of;
  tbb::parallel_for(std::size_t{0}, fine.size(), [&](std::size_t p) {
    if (cluster_of[p] != kNone) return;
    float strongest = 0.0f;
    for (std::size_t k = strong.begin(p); k < strong.end(p); ++k) {
      if (!is_taken(p, k) || fine.weights[k] <= strongest) continue;
      strongest = fine.weights[k];
      joined[p] = cluster_of[strong.at(k)];
    }
  });
  cluster_of = std::move(joined);
  return seeds;
}

}  // namespace

SmoothingLevel level_of_points(const SurfaceMesh& surface, std::span<const Vec<3>> normals) {
  SmoothingLevel level;
  level.neighbours = surface.neighbours();
  level.areas = surface.areas();
  level.positions = surface.positions();
  level.normals.assign(normals.begin(), normals.end());
  level.weights = cotangent_weights(surface);
  level.turns = turns_between_points(surface, normals);
  level.mean_edge = mean_edge_of(level);
  return level;
}

CoarserLevel make_coarser(const SmoothingLevel& fine) {
  CoarserLevel result;
  SmoothingLevel& coarse = result.level;
  const std::vector<std::uint32_t> seeds = make_clusters(fine, result.cluster_of);
  for (const std::uint32_t seed : seeds) coarse.normals.push_back(fine.normals[seed]);
  const TangentFrames frames(fine.normals);
  result.turns.resize(fine.size());
  tbb::parallel_for(std::size_t{0}, fine.size(), [&](std::size_t p) {
    const TangentFrame of_cluster = frames[seeds[result.cluster_of[p]]];
    result.turns[p] = std::complex<float>(line_at(transport(of_cluster, frames[p])));
  });

  struct Edge {
    std::uint32_t other;
    float weight;
    std::complex<float> turn;
  };
  result.places = places_of(result.cluster_of, seeds.size());
  std::vector<std::vector<Edge>> edges(seeds.size());  // one to each of a cluster's neighbours
  coarse.areas.assign(seeds.size(), 0.0);
  coarse.positions.assign(seeds.size(), Vec<3>(0.0));
  tbb::parallel_for(std::size_t{0}, seeds.size(), [&](std::size_t cluster) {
    std::vector<Edge> all;
    for (const std::uint32_t p : result.places[cluster]) {
      coarse.areas[cluster] += fine.areas[p];
      coarse.positions[cluster] += fine.positions[p];
      for (std::size_t k = fine.neighbours.starts[p]; k < fine.neighbours.starts[p + 1]; ++k) {
        const std::uint32_t q = fine.neighbours.items[k];
        const std::uint32_t other = result.cluster_of[q];
        if (other == cluster) continue;
        all.push_back({other, fine.weights[k], std::conj(result.turns[p]) * fine.turns[k] * result.turns[q]});
      }
    }
    coarse.positions[cluster] /= result.places[cluster].size();
    std::stable_sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) { return a.other < b.other; });
    for (std::size_t i = 0; i < all.size();) {
      Edge sum{all[i].other, 0.0f, 0.0f};
      for (; i < all.size() && all[i].other == sum.other; ++i) {
        sum.weight += all[i].weight;
        sum.turn += all[i].weight * all[i].turn;
      }
      edges[cluster].push_back(sum);
    }
  });

  for (const std::vector<Edge>& all : edges) {
    for (const Edge& edge : all) {
      coarse.neighbours.items.push_back(edge.other);
      coarse.weights.push_back(edge.weight);
      coarse.turns.push_back(edge.weight > 0.0f ? edge.turn / edge.weight : 0.0f);
    }
    coarse.neighbours.starts.push_back(static_cast<std::uint32_t>(coarse.neighbours.items.size()));
  }
  coarse.mean_edge = mean_edge_of(coarse);
  return result;
}

}  // namespace solidnoise
