#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace solidnoise {

// A value of an enumeration and the word that recipes and command lines use for it.
template <typename Enum>
struct Choice {
  Enum value;
  std::string_view name;
};

template <typename Enum, std::size_t Count>
using Choices = std::array<Choice<Enum>, Count>;

template <typename Enum, std::size_t Count>
constexpr std::string_view name_of(const Choices<Enum, Count>& choices, Enum value) {
  for (const Choice<Enum>& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  return {};
}

template <typename Enum, std::size_t Count>
std::vector<std::string_view> names_of(const Choices<Enum, Count>& choices) {
  std::vector<std::string_view> names;
  for (const Choice<Enum>& choice : choices) names.push_back(choice.name);
  return names;
}

// Which way is up.
enum class UpAxis { y, z };

inline constexpr Choices<UpAxis, 2> kUpAxisChoices{{{UpAxis::y, "y"}, {UpAxis::z, "z"}}};

// The one of `words` that `typed` was probably meant to be: the nearest within two mistakes, one in words of
// up to four letters. A mistake is a letter too many, too few or wrong, or two that are swapped. Empty if
// there is none.
std::string_view nearest_word(std::string_view typed, std::span<const std::string_view> words);

}  // namespace solidnoise
