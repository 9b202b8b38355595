#include "solidnoise/geometry/same_places.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

struct PlaceKey {
  std::uint64_t hash;
  std::uint32_t position;
};

std::uint64_t hash_of_place(const Vec<3>& place) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double unsigned_zero = place[axis] + 0.0;
    hash = hash_coordinate(hash, std::bit_cast<std::int64_t>(unsigned_zero));
  }
  return hash;
}

// For each of `count` positions the first one of an equal hash that `is_same`(first, position) takes for it.
std::vector<std::uint32_t> first_of_same(std::vector<PlaceKey> keys, std::size_t count,
                                         const std::function<bool(std::uint32_t, std::uint32_t)>& is_same) {
  tbb::parallel_sort(keys.begin(), keys.end(), [](const PlaceKey& a, const PlaceKey& b) {
    return a.hash != b.hash ? a.hash < b.hash : a.position < b.position;
  });
  std::vector<std::uint32_t> first(count);
  std::iota(first.begin(), first.end(), 0u);
  std::vector<std::uint32_t> distinct;  // of one hash: nearly always one
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    distinct.clear();
    for (; end < keys.size() && keys[end].hash == keys[begin].hash; ++end) {
      const std::uint32_t position = keys[end].position;
      const auto same = std::find_if(distinct.begin(), distinct.end(),
                                     [&](std::uint32_t other) { return is_same(other, position); });
      if (same == distinct.end()) {
        distinct.push_back(position);
      } else {
        first[position] = std::min(first[position], *same);
      }
    }
  }
  return first;
}

}  // namespace

std::vector<std::uint32_t> first_at_position(const std::vector<Vec<3>>& positions) {
  std::vector<PlaceKey> keys(positions.size());
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
    keys[i] = {hash_of_place(positions[i]), static_cast<std::uint32_t>(i)};
  });
  return first_of_same(std::move(keys), positions.size(), [&](std::uint32_t first, std::uint32_t position) {
    return positions[first] == positions[position];
  });
}

std::vector<std::uint32_t> first_across_gap(const std::vector<Vec<3>>& positions,
                                            const std::vector<double>& gaps) {
  // Cubes so large that most positions are in one with all that is within their gap; no gap reaches past the
  // next one.
  double cube = 0.0;
  for (const double gap : gaps) cube = std::max(cube, 8.0 * gap);
  std::vector<PlaceKey> keys;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!(gaps[i] > 0.0)) continue;
    std::array<std::uint64_t, 8> hashes;
    for (std::size_t corner = 0; corner < hashes.size(); ++corner) {
      const Vec<3> sides((corner & 1) == 0 ? -1.0 : 1.0, (corner & 2) == 0 ? -1.0 : 1.0,
                         (corner & 4) == 0 ? -1.0 : 1.0);
      hashes[corner] = hash_of_place(glm::floor((positions[i] + gaps[i] * sides) / cube));
    }
    std::sort(hashes.begin(), hashes.end());
    const auto end = std::unique(hashes.begin(), hashes.end());
    for (auto hash = hashes.begin(); hash != end; ++hash)
      keys.push_back({*hash, static_cast<std::uint32_t>(i)});
  }
  return first_of_same(std::move(keys), positions.size(), [&](std::uint32_t first, std::uint32_t position) {
    return glm::distance(positions[first], positions[position]) <= std::min(gaps[first], gaps[position]);
  });
}

}  // namespace solidnoise
