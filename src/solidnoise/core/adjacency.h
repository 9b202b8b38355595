#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace solidnoise {

// A list of indices for each element, all in one array: those of element i are
// items[starts[i]] .. items[starts[i + 1] - 1].
struct Adjacency {
  std::vector<std::uint32_t> starts{0};
  std::vector<std::uint32_t> items;

  std::size_t size() const { return starts.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t element) const {
    return std::span(items).subspan(starts[element], starts[element + 1] - starts[element]);
  }
};

// For each number below `count`: at which places in `numbers` it is, in ascending order.
// Precondition: all are below `count`.
Adjacency places_of(std::span<const std::uint32_t> numbers, std::size_t count);

}  // namespace solidnoise
