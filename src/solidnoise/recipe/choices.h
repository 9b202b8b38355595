#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "solidnoise/core/up_axis.h"
#include "solidnoise/noise/gabor/gabor_options.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"

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

inline constexpr Choices<UpAxis, 2> kUpAxisChoices{{{UpAxis::y, "y"}, {UpAxis::z, "z"}}};

inline constexpr Choices<ImpulseWeights, 2> kImpulseWeightChoices{{
    {ImpulseWeights::signs, "signs"},
    {ImpulseWeights::uniform, "uniform"},
}};

inline constexpr Choices<GradientNoiseOptions::Kernel, 2> kGradientKernelChoices{{
    {GradientNoiseOptions::Kernel::kensler, "kensler"},
    {GradientNoiseOptions::Kernel::zero_dc, "zero-dc"},
}};

inline constexpr Choices<GradientNoiseOptions::Support, 2> kGradientSupportChoices{{
    {GradientNoiseOptions::Support::full, "full"},
    {GradientNoiseOptions::Support::half, "half"},
}};

inline constexpr Choices<GradientNoiseOptions::Hash, 2> kGradientHashChoices{{
    {GradientNoiseOptions::Hash::xor_tables, "xor-tables"},
    {GradientNoiseOptions::Hash::integer, "integer"},
}};

}  // namespace solidnoise
