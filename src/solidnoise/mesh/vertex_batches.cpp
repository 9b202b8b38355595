#include "solidnoise/mesh/vertex_batches.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/parallel_sort.h>

namespace solidnoise {
namespace {

constexpr std::size_t kLargestBatch = 8192;  // vertices of a batch
constexpr double kParts = 8.0;               // along each side of a cube, in whose order its vertices are

// Vertices that are near each other, by index.
using VertexBatch = std::vector<std::uint32_t>;

// Sorts vertices into batches of up to some thousand: those of each cube of a grid, of this side, > 0.
// Positions must be finite.
std::vector<VertexBatch> make_batches(std::span<const Vec<3>> positions, double cube) {
  // In the order of the cubes, and in each in the order of its parts.
  struct Place {
    Vec<3> cube;
    Vec<3> part;
    std::uint32_t vertex;
  };
  const auto memory = std::make_unique_for_overwrite<Place[]>(positions.size());
  const std::span places(memory.get(), positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    const Vec<3> scaled = positions[i] / cube;
    const Vec<3> corner = glm::floor(scaled);
    places[i] = {corner, glm::floor((scaled - corner) * kParts), static_cast<std::uint32_t>(i)};
  });
  const auto before = [](const Vec<3>& a, const Vec<3>& b) {
    return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
  };
  tbb::parallel_sort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    if (a.cube != b.cube) return before(a.cube, b.cube);
    if (a.part != b.part) return before(a.part, b.part);
    return a.vertex < b.vertex;
  });

  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || places[i].cube != places[i - 1].cube || i - starts.back() == kLargestBatch)
      starts.push_back(i);
  }
  std::vector<VertexBatch> batches(starts.size());
  starts.push_back(places.size());
  tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t k) {
    const auto batch = places.subspan(starts[k], starts[k + 1] - starts[k]);
    batches[k].reserve(batch.size());
    for (const Place& place : batch) batches[k].push_back(place.vertex);
  });
  return batches;
}

}  // namespace

void for_each_batch(const BakeVertices& vertices, double cube, Progress* progress,
                    const std::function<void(const Points<3>&)>& use) {
  const std::vector<VertexBatch> batches = make_batches(vertices.positions, cube);
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for_each(batches, [&](const VertexBatch& batch) {
    throw_if_cancelled(progress);
    std::vector<Vec<3>> positions;
    std::vector<Vec<3>> normals;
    for (const std::uint32_t vertex : batch) {
      positions.push_back(vertices.positions[vertex]);
      normals.push_back(vertices.normals[vertex]);
    }
    use(Points<3>{positions, normals, batch});
    if (progress) progress->advance(done += batch.size(), vertices.positions.size());
  });
}

}  // namespace solidnoise
