#include "common/parse_value.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "common/usage_error.h"

namespace solidnoise {
namespace {

[[noreturn]] void refuse(const std::string& flag, const std::string& text, std::string_view allowed) {
  throw UsageError(fmt::format("{} is {}; it must be {}", flag, text.empty() ? "empty" : text, allowed));
}

// Reads the text from `begin` as far as it is a value; returns where it stopped, or nullptr if it is none.
template <typename Value>
const char* read_value(const std::string& text, Value& value) {
  const char* const begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  return error == std::errc() ? end : nullptr;
}

template <typename Value>
Value parse_whole(const std::string& flag, const std::string& text, std::string_view allowed) {
  Value value{};
  if (read_value(text, value) != text.data() + text.size()) refuse(flag, text, allowed);
  return value;
}

}  // namespace

double parse_number(const std::string& flag, const std::string& text) {
  const double value = parse_whole<double>(flag, text, "a number");
  if (!std::isfinite(value)) refuse(flag, text, "a finite number");
  return value;
}

int parse_integer(const std::string& flag, const std::string& text) {
  return parse_whole<int>(flag, text, "a whole number");
}

std::uint64_t parse_unsigned(const std::string& flag, const std::string& text) {
  return parse_whole<std::uint64_t>(flag, text, "a whole number from 0 to 18446744073709551615");
}

std::uint64_t parse_bytes(const std::string& flag, const std::string& text) {
  constexpr std::string_view kAllowed = "a number of bytes, such as 500M or 8G";
  double number = 0.0;
  const char* const end = read_value(text, number);
  if (!end || !std::isfinite(number) || number <= 0.0) refuse(flag, text, kAllowed);

  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (!unit.empty() && (unit.back() == 'B' || unit.back() == 'b')) unit.remove_suffix(1);
  if (!unit.empty() && unit.back() == 'i') unit.remove_suffix(1);
  constexpr std::string_view kPowersOf1024 = "KMGT";
  double scale = 1.0;
  if (!unit.empty()) {
    const std::size_t power = kPowersOf1024.find(static_cast<char>(unit[0] & ~0x20));
    if (unit.size() != 1 || power == std::string_view::npos) refuse(flag, text, kAllowed);
    scale = std::pow(1024.0, static_cast<double>(power + 1));
  }
  if (number * scale >= 0x1p63) refuse(flag, text, "below 8 million TiB");
  return static_cast<std::uint64_t>(number * scale);
}

}  // namespace solidnoise
