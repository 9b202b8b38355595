#include "solidnoise/core/adjacency.h"

#include <numeric>

namespace solidnoise {

Adjacency places_of(std::span<const std::uint32_t> numbers, std::size_t count) {
  Adjacency places;
  places.starts.assign(count + 1, 0);
  for (const std::uint32_t number : numbers) ++places.starts[number + 1];
  std::partial_sum(places.starts.begin(), places.starts.end(), places.starts.begin());
  places.items.resize(numbers.size());
  std::vector<std::uint32_t> next(places.starts.begin(), places.starts.end() - 1);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    places.items[next[numbers[i]]++] = static_cast<std::uint32_t>(i);
  return places;
}

}  // namespace solidnoise
