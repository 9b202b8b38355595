#pragma once

// In the place of TBB: the same calls, one after the other. A page's threads are its workers.

#include <algorithm>
#include <cstddef>
#include <functional>

namespace tbb {

template <typename Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t = 1) : begin_(begin), end_(end) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }

 private:
  Index begin_;
  Index end_;
};

template <typename Index, typename Body>
void parallel_for(Index first, Index last, const Body& body) {
  for (Index i = first; i < last; ++i) body(i);
}
template <typename Index, typename Body>
void parallel_for(const blocked_range<Index>& range, const Body& body) {
  body(range);
}
template <typename Range, typename Body>
void parallel_for_each(Range&& range, const Body& body) {
  for (auto& element : range) body(element);
}

// In blocks of the grain would be as exact; sums of all at once differ in the last bits.
template <typename Index, typename Value, typename Body, typename Join>
Value parallel_deterministic_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body,
                                    const Join&) {
  return body(range, identity);
}
template <typename Index, typename Value, typename Body, typename Join>
Value parallel_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body, const Join&) {
  return body(range, identity);
}

template <typename Iterator, typename Before = std::less<>>
void parallel_sort(Iterator first, Iterator last, const Before& before = {}) {
  std::sort(first, last, before);
}

template <typename Value>
class enumerable_thread_specific {
 public:
  template <typename Make>
  explicit enumerable_thread_specific(const Make& make) : value_(make()) {}
  explicit enumerable_thread_specific(const Value& value) : value_(value) {}
  Value& local() { return value_; }

 private:
  Value value_;
};

}  // namespace tbb
