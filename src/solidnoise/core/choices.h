#pragma once

#include <array>
#include <cstddef>
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

}  // namespace solidnoise
