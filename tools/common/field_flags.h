#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/flag_set.h"
#include "common/parse_value.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {

// Flags made from tables of fields (core/fields.h).

// "--smooth-radius" of the field "smooth_radius".
std::string flag_of(std::string_view field);

// What stands for a number of this unit: "OCTAVES".
std::string number_name(std::string_view unit);

// "Width of the band at half amplitude [octaves; 0.05 to 4] (default 1)". The default is left out where it is
// empty.
std::string help_of(std::string_view help, std::string_view unit, const Interval& allowed,
                    const std::string& default_value);

// Numbers with the fewest digits and a space between; without those beyond three that are 0.
std::string format_numbers(std::vector<double> numbers);

template <typename Value>
Value vector_of(const std::vector<double>& numbers) {
  Value vector(0.0);
  for (std::size_t axis = 0; axis < numbers.size(); ++axis) {
    vector[static_cast<int>(axis)] = numbers[axis];
  }
  return vector;
}

// Fields that can have a flag: words, seeds, numbers and vectors. Flags of others are declared by hand.
template <typename Value>
concept HasFlagForm = std::is_enum_v<Value> || std::same_as<Value, std::uint64_t> ||
    std::same_as<Value, int> || std::same_as<Value, double> || std::same_as<Value, std::optional<double>> ||
    std::same_as<Value, std::array<double, 2>> || requires {
  Value::length();
};

// Calls visit(field, owner) for each field of a struct that has a flag.
template <typename Struct, typename Visit>
void for_each_flag(Struct&& object, const Visit& visit) {
  for_each_field(object, [&]<typename F, typename Owner>(const F& field, Owner& owner) {
    if constexpr (HasFlagForm<ValueOf<F, Owner>>) {
      if (field.has_flag) visit(field, owner);
    }
  });
}

// Declares the flag of a field, whose default is that of `owner`; set(value) is what it does. `before` stands
// before the help.
template <typename F, typename Struct, typename Set>
void declare_field(FlagSet& flags, const F& field, const Struct& owner, const std::string& before,
                   const Set& set) {
  using Value = ValueOf<F, Struct>;
  const std::string flag = flag_of(field.name);
  const Value value = field.get(owner);
  const std::string help = before + std::string(field.help);
  if constexpr (std::is_enum_v<Value>) {
    const auto choices = field.allowed;
    flags.choice(flag, names_of(choices), help_of(help, {}, {}, std::string(name_of(choices, value))),
                 [=](std::size_t index) { set(choices[index].value); });
  } else if constexpr (std::same_as<Value, std::uint64_t>) {
    flags.text(flag, "INTEGER", help_of(help, "0 to 18446744073709551615", {}, std::to_string(value)),
               [=](const std::string& text) { set(parse_unsigned(flag, text)); });
  } else {
    std::vector<double> defaults;
    for_each_number(value, [&](double number) { defaults.push_back(number); });
    const std::string numbers_help = help_of(help, field.unit, field.allowed, format_numbers(defaults));
    const std::string name = number_name(field.unit);
    if constexpr (std::same_as<Value, int>) {
      flags.integer(flag, "COUNT", numbers_help, set);
    } else if constexpr (std::same_as<Value, double> || std::same_as<Value, std::optional<double>>) {
      flags.number(flag, name, numbers_help, set);
    } else if constexpr (std::same_as<Value, std::array<double, 2>>) {
      flags.numbers(flag, "LOW HIGH", 2, numbers_help, [=](const std::vector<double>& v) {
        set(std::array{v[0], v[1]});
      });
    } else {
      constexpr int kAxes = Value::length();
      static_assert(kAxes == 3 || kAxes == 4, "a flag of this type is to be declared by hand");
      flags.numbers(flag, kAxes == 3 ? "X Y Z" : "X Y Z [T]", 3, numbers_help,
                    [=](const std::vector<double>& v) { set(vector_of<Value>(v)); });
    }
  }
}

// Declares the flags of the fields of a struct, of all or of those with these names; they set it.
template <HasFields Struct>
void declare_fields(FlagSet& flags, Struct& object, std::initializer_list<std::string_view> names = {}) {
  for_each_flag(object, [&]<typename F, typename Owner>(const F& field, Owner& owner) {
    const bool is_named = std::find(names.begin(), names.end(), field.name) != names.end();
    if (names.size() > 0 && !is_named) return;
    declare_field(flags, field, Owner{}, "",
                  [field, &owner](const ValueOf<F, Owner>& value) { field.set(owner, value); });
  });
}

// Declares the flags of a noise, those of the tables of all noises, which act on `recipe` when they are
// applied. A flag that the noise has no use for is refused then.
void declare_noise_flags(FlagSet& flags, NoiseRecipe& recipe);

// These flags.
std::vector<std::string> noise_flags();

// Declares --generator. Declare it after all other flags of the noise and of its dimensions.
void declare_generator_flag(FlagSet& flags, NoiseRecipe& recipe, const int& dims);

// Makes it another kind of noise ("gabor-oriented"), with what the old one and it have in common.
void change_noise_type(NoiseRecipe& recipe, const std::string& type);

}  // namespace solidnoise
