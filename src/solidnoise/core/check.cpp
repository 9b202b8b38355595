#include "solidnoise/core/check.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace solidnoise {
namespace {

[[noreturn]] void refuse(std::string_view field, double value, const std::string& allowed,
                         std::string_view unit) {
  const std::string suffix = unit.empty() ? std::string() : fmt::format(" ({})", unit);
  throw std::invalid_argument(fmt::format("{} is {}; it must be {}{}", field, value, allowed, suffix));
}

}  // namespace

void require_finite(std::string_view field, double value) {
  if (!std::isfinite(value)) refuse(field, value, "a finite number", {});
}

void require_positive(std::string_view field, double value, std::string_view unit) {
  if (!std::isfinite(value) || value <= 0.0) refuse(field, value, "greater than 0", unit);
}

void require_at_least(std::string_view field, double value, double lowest, std::string_view unit) {
  if (!std::isfinite(value) || value < lowest) refuse(field, value, fmt::format("at least {}", lowest), unit);
}

void require_in_range(std::string_view field, double value, double lowest, double highest,
                      std::string_view unit) {
  if (!std::isfinite(value) || value < lowest || value > highest) {
    refuse(field, value, fmt::format("between {} and {}", lowest, highest), unit);
  }
}

}  // namespace solidnoise
