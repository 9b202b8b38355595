#include "solidnoise/core/format_bytes.h"

#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace solidnoise {

std::string format_bytes(std::uint64_t bytes) {
  constexpr std::array kUnits{"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double number = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (number >= 1024.0 && unit + 1 < kUnits.size()) {
    number /= 1024.0;
    ++unit;
  }
  return unit == 0 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} {}", number, kUnits[unit]);
}

}  // namespace solidnoise
