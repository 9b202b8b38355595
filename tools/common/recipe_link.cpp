#include "common/recipe_link.h"

#include <cstdint>
#include <stdexcept>

namespace solidnoise {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

std::string decode(std::string_view code) {
  std::string text;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : code) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) throw std::runtime_error("the link's recipe is damaged");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    text += static_cast<char>(bits >> count & 0xff);
  }
  return text;
}

}  // namespace

std::optional<std::string> recipe_in_link(std::string_view link) {
  if (!link.starts_with("http://") && !link.starts_with("https://")) return std::nullopt;
  constexpr std::string_view kKey = "recipe=";
  std::size_t begin = link.find('#');
  while (begin != std::string_view::npos) {
    const std::string_view part = link.substr(begin + 1);
    if (part.starts_with(kKey)) return decode(part.substr(kKey.size(), part.find('&') - kKey.size()));
    begin = link.find('&', begin + 1);
  }
  throw std::runtime_error(
      "the link has no recipe; it must be one of Solidnoise Studio, with #recipe= in it");
}

}  // namespace solidnoise
