#pragma once

#include <cstdint>

namespace solidnoise {

// The largest whole number that is no more than i / divisor; divisor > 0.
inline std::int64_t divide_down(std::int64_t i, int divisor) {
  const std::int64_t quotient = i / divisor;
  return quotient * divisor > i ? quotient - 1 : quotient;
}

}  // namespace solidnoise
