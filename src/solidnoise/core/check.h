#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace solidnoise {

// No option is larger than this, of either sign: products of a few of them with what a grid holds are still
// finite in single precision or refused by what they mean.
inline constexpr double kLargestOption = 1e30;

// The numbers that an option may have. Not-a-number and what is beyond kLargestOption are never among them.
struct Interval {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool without_least = false;

  bool contains(double value) const {
    return std::abs(value) <= kLargestOption && (without_least ? value > least : value >= least) &&
           value <= most;
  }
  // "greater than 0", "at least 0", "between 0.05 and 4", "a finite number".
  std::string text() const;
};

inline constexpr Interval kFinite{};
inline constexpr Interval kPositive{.least = 0.0, .without_least = true};
constexpr Interval at_least(double least) {
  return {.least = least};
}
constexpr Interval between(double least, double most) {
  return {.least = least, .most = most};
}

// Checks of options. Each throws std::invalid_argument with one line: the field, its value, what is allowed.
// `field` is the option's name as the user knows it; `unit` is added in parentheses where it is not empty and
// not every finite number is allowed.
void require(std::string_view field, double value, const Interval& allowed, std::string_view unit = {});
void require_finite(std::string_view field, double value);
void require_positive(std::string_view field, double value, std::string_view unit = {});
void require_at_least(std::string_view field, double value, double lowest, std::string_view unit = {});
void require_in_range(std::string_view field, double value, double lowest, double highest,
                      std::string_view unit = {});

// Of an array of the caller's that is written to: "values has room for 4 numbers; it must have room for 5".
void require_room(std::string_view name, std::size_t room, std::size_t needed);

}  // namespace solidnoise
