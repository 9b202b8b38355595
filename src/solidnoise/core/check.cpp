#include "solidnoise/core/check.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {

std::string Interval::text() const {
  const bool is_bounded_above = std::isfinite(most);
  if (!std::isfinite(least)) return is_bounded_above ? fmt::format("at most {}", most) : "a finite number";
  if (without_least) {
    return is_bounded_above ? fmt::format("greater than {} and at most {}", least, most)
                            : fmt::format("greater than {}", least);
  }
  return is_bounded_above ? fmt::format("between {} and {}", least, most) : fmt::format("at least {}", least);
}

void require(std::string_view field, double value, const Interval& allowed, std::string_view unit) {
  if (allowed.contains(value)) return;
  if (std::isfinite(value) && std::abs(value) > kLargestOption &&
      allowed.contains(std::copysign(kLargestOption, value))) {
    throw std::invalid_argument(
        fmt::format("{} is {}; it must be at most {} in size", field, value, kLargestOption));
  }
  const bool is_any = !std::isfinite(allowed.least) && !std::isfinite(allowed.most);
  const std::string suffix = unit.empty() || is_any ? std::string() : fmt::format(" ({})", unit);
  throw std::invalid_argument(fmt::format("{} is {}; it must be {}{}", field, value, allowed.text(), suffix));
}

void require_finite(std::string_view field, double value) {
  require(field, value, kFinite);
}

void require_positive(std::string_view field, double value, std::string_view unit) {
  require(field, value, kPositive, unit);
}

void require_at_least(std::string_view field, double value, double lowest, std::string_view unit) {
  require(field, value, at_least(lowest), unit);
}

void require_in_range(std::string_view field, double value, double lowest, double highest,
                      std::string_view unit) {
  require(field, value, between(lowest, highest), unit);
}

void require_room(std::string_view name, std::size_t room, std::size_t needed) {
  if (room >= needed) return;
  throw std::invalid_argument(
      fmt::format("{} has room for {} numbers; it must have room for {}", name, room, needed));
}

}  // namespace solidnoise
