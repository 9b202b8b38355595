#pragma once

// What Emscripten 3.1.6's standard library lacks of C++20 and of C++17's mathematical functions; every file is compiled with it.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>

namespace std {

template <typename T>
  requires is_unbounded_array_v<T>
unique_ptr<T> make_unique_for_overwrite(size_t count) {
  return unique_ptr<T>(new remove_extent_t<T>[count]);
}

double beta(double a, double b);
double cyl_bessel_j(double order, double x);

from_chars_result from_chars(const char* first, const char* last, double& value);
from_chars_result from_chars(const char* first, const char* last, float& value);

namespace ranges {

template <typename Range, typename Test>
bool all_of(const Range& range, Test test) {
  return std::all_of(std::begin(range), std::end(range), std::move(test));
}
template <typename Range, typename Test>
bool any_of(const Range& range, Test test) {
  return std::any_of(std::begin(range), std::end(range), std::move(test));
}
template <typename Range, typename Test>
auto count_if(const Range& range, Test test) {
  return std::count_if(std::begin(range), std::end(range), std::move(test));
}
template <typename Range, typename Test>
auto find_if(Range& range, Test test) {
  return std::find_if(std::begin(range), std::end(range), std::move(test));
}
template <typename Range, typename Value>
auto find(Range& range, const Value& value) {
  return std::find(std::begin(range), std::end(range), value);
}
template <typename Range, typename Other, typename Same>
bool equal(const Range& range, const Other& other, Same same) {
  return std::equal(std::begin(range), std::end(range), std::begin(other), std::end(other), std::move(same));
}
template <typename Range, typename Output>
void copy(const Range& range, Output output) {
  std::copy(std::begin(range), std::end(range), std::move(output));
}
template <typename Range, typename Output, typename Map>
void transform(const Range& range, Output output, Map map) {
  std::transform(std::begin(range), std::end(range), std::move(output), std::move(map));
}
template <typename Range>
auto minmax(const Range& range) {
  using Value = std::decay_t<decltype(*std::begin(range))>;
  struct Ends {
    Value min;
    Value max;
  };
  const auto found = std::minmax_element(std::begin(range), std::end(range));
  return Ends{*found.first, *found.second};
}

}  // namespace ranges
}  // namespace std
