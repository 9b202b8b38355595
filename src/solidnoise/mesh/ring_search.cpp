#include "solidnoise/mesh/ring_search.h"

#include <algorithm>

namespace solidnoise {
namespace {

constexpr std::size_t kMostPerPoint = 48;
constexpr std::size_t kMostPerRing = 96;
constexpr int kMostRings = 8;

}  // namespace

const std::vector<std::uint32_t>& RingSearch::around(std::uint32_t centre, std::size_t count) {
  if (++search_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    search_ = 1;
  }
  found_.clear();
  seen_[centre] = search_;
  add_neighbours(centre);
  std::size_t begin = 0;
  for (int ring = 2; ring <= kMostRings && begin < found_.size(); ++ring) {
    if (ring > 2 && found_.size() >= count) break;
    const std::size_t end = found_.size();
    add_ring(begin);
    begin = end;
  }
  return found_;
}

void RingSearch::add_ring(std::size_t begin) {
  const std::size_t end = found_.size();
  for (std::size_t i = begin; i < end; ++i) add_neighbours(found_[i]);
  const std::size_t added = found_.size() - end;
  if (added <= kMostPerRing) return;
  for (std::size_t i = 0; i < kMostPerRing; ++i) found_[end + i] = found_[end + i * added / kMostPerRing];
  found_.resize(end + kMostPerRing);
}

void RingSearch::add_neighbours(std::uint32_t point) {
  const auto neighbours = neighbours_[point];
  const std::size_t taken = std::min(neighbours.size(), kMostPerPoint);
  for (std::size_t i = 0; i < taken; ++i) {
    const std::uint32_t other = neighbours[i * neighbours.size() / taken];
    if (seen_[other] == search_) continue;
    seen_[other] = search_;
    found_.push_back(other);
  }
}

}  // namespace solidnoise
