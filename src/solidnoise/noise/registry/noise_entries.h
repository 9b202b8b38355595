#pragma once

#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "solidnoise/noise/cellular/cellular_entry.h"
#include "solidnoise/noise/gabor/gabor_entries.h"
#include "solidnoise/noise/gradient/gradient_entry.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// The entries of all noises, in the order of the alternatives of NoiseRecipe::noise.
using NoiseVariant = decltype(NoiseRecipe::noise);

// Calls visit(std::type_identity<Options>()) for each.
template <typename Visit>
constexpr void for_each_noise(const Visit& visit) {
  []<typename... Options>(std::type_identity<std::variant<Options...>>, const Visit& each) {
    (each(std::type_identity<Options>()), ...);
  }(std::type_identity<NoiseVariant>(), visit);
}

// The names of the noises for which test(std::type_identity<Options>()) is true.
template <typename Test>
std::vector<std::string_view> noise_names(const Test& test) {
  std::vector<std::string_view> names;
  for_each_noise([&]<typename Options>(std::type_identity<Options> type) {
    if (test(type)) names.push_back(NoiseEntry<Options>::kName);
  });
  return names;
}
inline std::vector<std::string_view> noise_names() {
  return noise_names([](auto) { return true; });
}

// Says what the files of a noise lack.
template <typename Options>
constexpr bool require_entry() {
  static_assert(
      requires { sizeof(NoiseEntry<Options>); }, "a noise needs a NoiseEntry<Options>, included above");
  static_assert(HasFields<Options>, "a noise needs a table of its options: fields_of()");
  static_assert(
      requires(Options options) {
        options.frequency;
        options.seed;
        options.period;
        options.validate();
      },
      "the options of a noise need frequency, seed, period and validate()");
  using Entry = NoiseEntry<Options>;
  static_assert(
      requires {
        std::string_view(Entry::kName);
        std::string_view(Entry::kTitle);
        std::string_view(Entry::kHelp);
      },
      "the entry of a noise needs kName, kTitle and kHelp");
  static_assert(Entry::kLeastDimensions <= 3 && Entry::kMostDimensions >= 3, "a noise has 3 dimensions");
  static_assert(std::is_constructible_v<typename Entry::template Noise<3>, const Options&>,
                "the entry of a noise needs Noise<Dim>, made of its options");
  constexpr auto ignore = [](std::string_view, const auto&) {};
  static_assert(
      requires(const Options& options) {
        Entry::template describe<3>(options, ignore, ignore);
        KernelSlice(Entry::template slice<3>(options));
      },
      "the entry of a noise needs describe<Dim>() and slice<Dim>()");
  return true;
}
static_assert([] {
  for_each_noise([]<typename Options>(std::type_identity<Options>) { require_entry<Options>(); });
  return true;
}());

}  // namespace solidnoise
