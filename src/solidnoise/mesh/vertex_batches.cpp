#include "solidnoise/mesh/vertex_batches.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace solidnoise {
namespace {

constexpr std::size_t kLargest = 8192;  // vertices of a batch
constexpr double kParts = 8.0;          // along each side of a cube, in whose order its vertices are

}  // namespace

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
    if (i == 0 || places[i].cube != places[i - 1].cube || i - starts.back() == kLargest) starts.push_back(i);
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

}  // namespace solidnoise
