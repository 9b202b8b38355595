#include "solidnoise/core/printable.h"

#include <algorithm>

#include <fmt/format.h>

namespace solidnoise {
namespace {

constexpr unsigned char byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

// Whether a text begins with a control of the direction of writing, which would show what comes after in
// another order: U+202A to U+202E, U+2066 to U+2069.
bool turns_direction(std::string_view text) {
  if (!text.starts_with("\xe2\x80") && !text.starts_with("\xe2\x81")) return false;
  const unsigned char last = byte_at(text, 2);
  return byte_at(text, 1) == 0x80 ? last >= 0xaa && last <= 0xae : last >= 0xa6 && last <= 0xa9;
}

// The bytes of the first character if it may be shown, or 0. The controls from U+0080 to U+009F may not.
std::size_t shown_length(std::string_view text) {
  const unsigned char first = byte_at(text, 0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xc0) != 0x80) return 0;
  }
  // Of three bytes or four, those that fewer have, surrogates, and what is beyond U+10FFFF.
  const unsigned char second = byte_at(text, 1);
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0)) return 0;
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90)) return 0;
  const bool is_control = first == 0xc2 && byte_at(text, 1) < 0xa0;
  return is_control || turns_direction(text) ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = shown_length(text);
    const std::string next =
        length > 0 ? std::string(text.substr(0, length)) : fmt::format("\\x{:02x}", byte_at(text, 0));
    if (shown.size() + next.size() > most) return shown + "...";
    shown += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

}  // namespace solidnoise
