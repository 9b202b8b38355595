#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// Calls `function` with a value of the C++ type that `type` stands for.
template <typename Function>
auto visit_scalar_type(ScalarType type, const Function& function) {
  switch (type) {
    case ScalarType::int8:
      return function(std::int8_t{});
    case ScalarType::uint8:
      return function(std::uint8_t{});
    case ScalarType::int16:
      return function(std::int16_t{});
    case ScalarType::uint16:
      return function(std::uint16_t{});
    case ScalarType::int32:
      return function(std::int32_t{});
    case ScalarType::uint32:
      return function(std::uint32_t{});
    case ScalarType::float32:
      return function(float{});
    case ScalarType::float64:
      return function(double{});
  }
  throw std::invalid_argument("unknown scalar type");
}

constexpr bool is_float(ScalarType type) {
  return type == ScalarType::float32 || type == ScalarType::float64;
}

// Bytes of a number.
inline std::size_t size_of(ScalarType type) {
  return visit_scalar_type(type, [](auto value) { return sizeof(value); });
}

// The float32 that is nearest, infinite if none is as large.
inline float nearest_float(double value) {
  using Limits = std::numeric_limits<float>;
  if (!(std::abs(value) > static_cast<double>(Limits::max()))) return static_cast<float>(value);
  return value > 0.0 ? Limits::infinity() : -Limits::infinity();
}

// The number of a type that is nearest; 0 in integers for what is not a number.
template <typename Number>
Number nearest_number(double value) {
  using Limits = std::numeric_limits<Number>;
  if constexpr (std::is_same_v<Number, double>) {
    return value;
  } else if constexpr (std::is_same_v<Number, float>) {
    return nearest_float(value);
  } else {
    if (std::isnan(value)) return 0;
    return static_cast<Number>(std::clamp(std::round(value), static_cast<double>(Limits::min()),
                                          static_cast<double>(Limits::max())));
  }
}

// Takes numbers off the front of a file's bytes. Precondition of each function: as many are left.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::endian order) : rest_(bytes), swap_(order != std::endian::native) {}

  std::size_t left() const { return rest_.size(); }

  std::string_view take_bytes(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  template <typename Number>
  Number take() {
    char raw[sizeof(Number)];
    std::memcpy(raw, rest_.data(), sizeof raw);
    rest_.remove_prefix(sizeof raw);
    if (swap_) std::reverse(raw, raw + sizeof raw);
    Number number;
    std::memcpy(&number, raw, sizeof raw);
    return number;
  }

 private:
  std::string_view rest_;
  bool swap_;
};

}  // namespace solidnoise
