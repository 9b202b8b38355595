#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/ply_header.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {

// The rows of a PLY file's elements, one value after the other. PlyTextRows and PlyBinaryRows have the same
// functions: a row is begun, its values are taken, it is ended. refuse() throws std::runtime_error naming the
// path, the line where there is one, and the row, by its element's name and its index.
class PlyTextRows {
 public:
  PlyTextRows(std::string_view body, const std::string& name, const PlyHeader& header)
      : lines_(body, name, header.lines) {}

  // Bytes that the smallest row takes: a digit and what parts it from the next, per value. A list may be 0.
  static std::uint64_t smallest_row(const PlyElement& element) { return 2 * element.properties.size(); }
  // The last number of a file may end with it.
  std::uint64_t left() const { return lines_.rest().size() + 1; }
  std::uint64_t left_in_row() const { return text_.size() + 1; }
  bool at_end() const { return lines_.rest().find_first_not_of(" \t\r\n") == std::string_view::npos; }
  static std::uint64_t smallest_value(ScalarType) { return 2; }

  void begin_row(const PlyElement& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
    if (element.properties.empty()) return;
    bool found = false;
    while (!found && lines_.next()) found = !trim(lines_.line()).empty();
    if (!found) {
      throw std::runtime_error(fmt::format("{}: the file ends at {} {} of {}", lines_.name(),
                                           printable(element.name), index, element.count));
    }
    text_ = lines_.line();
  }

  double take(ScalarType type) {
    const std::string_view word = take_word(text_);
    if (word.empty()) refuse("a value is missing");
    const std::optional<double> number = parse_double(word);
    if (!number || !fits(*number, type)) {
      refuse(fmt::format("'{}' is not {}", printable(word),
                         is_float(type) ? std::string("a number")
                                        : fmt::format("an integer of type {}", ply_type_name(type))));
    }
    return type == ScalarType::float32 ? static_cast<double>(nearest_float(*number)) : *number;
  }

  void end_row() {
    if (element_->properties.empty()) return;
    const std::string_view word = take_word(text_);
    if (!word.empty()) refuse(fmt::format("there is '{}' after the last value", printable(word)));
  }

  [[noreturn]] void refuse(const std::string& what) const {
    lines_.refuse(fmt::format("{} {}: {}", printable(element_->name), index_, what));
  }

 private:
  static bool fits(double number, ScalarType type) {
    return visit_scalar_type(type, [&](auto value) {
      using Number = decltype(value);
      using Limits = std::numeric_limits<Number>;
      if constexpr (Limits::is_integer) {
        return number >= Limits::min() && number <= Limits::max() && number == std::floor(number);
      } else {
        return true;
      }
    });
  }

  TextLines lines_;
  std::string_view text_;
  const PlyElement* element_ = nullptr;
  std::uint64_t index_ = 0;
};

class PlyBinaryRows {
 public:
  PlyBinaryRows(std::string_view body, const std::string& name, const PlyHeader& header)
      : bytes_(body,
               header.encoding == PlyEncoding::binary_big_endian ? std::endian::big : std::endian::little),
        name_(name) {}

  static std::uint64_t smallest_row(const PlyElement& element) {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
      bytes += size_of(property.count_type.value_or(property.type));
    }
    return bytes;
  }
  std::uint64_t left() const { return bytes_.left(); }
  std::uint64_t left_in_row() const { return left(); }
  bool at_end() const { return left() == 0; }
  static std::uint64_t smallest_value(ScalarType type) { return size_of(type); }

  void begin_row(const PlyElement& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }

  double take(ScalarType type) {
    return visit_scalar_type(type, [this](auto value) {
      if (bytes_.left() < sizeof value) {
        throw std::runtime_error(fmt::format("{}: the file ends at {} {} of {}", name_,
                                             printable(element_->name), index_, element_->count));
      }
      return static_cast<double>(bytes_.take<decltype(value)>());
    });
  }

  void end_row() {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {} {}: {}", name_, printable(element_->name), index_, what));
  }

 private:
  ByteReader bytes_;
  const std::string& name_;
  const PlyElement* element_ = nullptr;
  std::uint64_t index_ = 0;
};

}  // namespace solidnoise
