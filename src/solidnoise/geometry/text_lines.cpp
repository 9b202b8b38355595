#include "solidnoise/geometry/text_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {
namespace {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

std::string_view take_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> parse_double(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double number = 0.0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (rest != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return number;
  // Out of range: too large or too small is told by the sign of the exponent, or without one by the number of
  // digits before the point.
  const std::size_t exponent = word.find_first_of("eE");
  const bool tiny = exponent != std::string_view::npos ? word.substr(exponent + 1).starts_with('-')
                                                       : word.find_first_of("123456789") > word.find('.');
  const double magnitude = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  return word.starts_with('-') ? -magnitude : magnitude;
}

bool needs_float64(std::string_view word, double number) {
  if (std::abs(number) > std::numeric_limits<float>::max()) return true;
  word = word.substr(0, word.find_first_of("eE"));
  word.remove_prefix(std::min(word.find_first_of("123456789"), word.size()));
  constexpr std::ptrdiff_t kDigitsOfFloat32 = 9;
  return static_cast<std::ptrdiff_t>(word.size()) - std::count(word.begin(), word.end(), '.') >
         kDigitsOfFloat32;
}

bool TextLines::next() {
  if (rest_.empty()) return false;
  ++number_;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  return true;
}

bool TextLines::next_filled(char mark) {
  while (next()) {
    line_ = trim(line_.substr(0, line_.find(mark)));
    if (!line_.empty()) return true;
  }
  return false;
}

void TextLines::refuse(const std::string& what) const {
  throw std::runtime_error(fmt::format("{}:{}: {}", name_, number_, what));
}

}  // namespace solidnoise
