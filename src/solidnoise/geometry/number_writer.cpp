#include "solidnoise/geometry/number_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "solidnoise/geometry/scalar_type.h"

namespace solidnoise {
namespace {

template <typename Number>
void append_decimal(std::string& buffer, Number value) {
  std::array<char, 32> digits;  // a double takes 24 at most
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  buffer.append(digits.data(), end);
}

}  // namespace

void NumberWriter::text(std::string_view text) {
  buffer_ += text;
  flush_if_full();
}

void NumberWriter::decimal(double value, ScalarType type) {
  visit_scalar_type(type,
                    [&](auto number) { append_decimal(buffer_, nearest_number<decltype(number)>(value)); });
  flush_if_full();
}

void NumberWriter::finite_decimal(double value, ScalarType type) {
  const bool finite =
      std::isfinite(type == ScalarType::float32 ? static_cast<double>(nearest_float(value)) : value);
  decimal(finite ? value : 0.0, type);
}

void NumberWriter::decimal(std::uint64_t value) {
  append_decimal(buffer_, value);
  flush_if_full();
}

void NumberWriter::decimal(double value) {
  const auto single = nearest_number<float>(value);
  decimal(value, static_cast<double>(single) == value ? ScalarType::float32 : ScalarType::float64);
}

void NumberWriter::bytes(double value, ScalarType type) {
  visit_scalar_type(type, [&](auto number) {
    const auto converted = nearest_number<decltype(number)>(value);
    char raw[sizeof converted];
    std::memcpy(raw, &converted, sizeof raw);
    if (order_ != std::endian::native) std::reverse(raw, raw + sizeof raw);
    buffer_.append(raw, sizeof raw);
  });
  flush_if_full();
}

void NumberWriter::finish() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void NumberWriter::flush_if_full() {
  constexpr std::size_t kFull = std::size_t{1} << 16;
  if (buffer_.size() >= kFull) finish();
}

void write_comments(NumberWriter& out, std::string_view mark, const std::vector<std::string>& comments) {
  for (std::string_view comment : comments) {
    for (bool more = true; more;) {
      const std::size_t end = comment.find_first_of("\r\n");
      const std::string_view line = comment.substr(0, end);
      out.text(mark);
      if (!line.empty()) out.text(" ");
      out.text(line);
      out.text("\n");
      more = end != std::string_view::npos;
      if (more) comment.remove_prefix(end + 1);
    }
  }
}

ScalarType stored_position_type(const PolygonMesh& mesh) {
  if (mesh.position_type == ScalarType::float64) return ScalarType::float64;
  for (const Vec<3>& p : mesh.positions) {
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (largest > static_cast<double>(std::numeric_limits<float>::max())) return ScalarType::float64;
  }
  return ScalarType::float32;
}

}  // namespace solidnoise
