#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/flag_help.h"
#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/bounds.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// How the values of a type are written on a command line, as flags that are made from tables have it; to be
// specialised beside further types:
//   static constexpr auto kNumbers = Flag::Numbers::none;            // what they are made of
//   static std::string names(std::string_view unit);                 // what stands for them in help: "X Y Z"
//   static Value read(const std::string& flag, const std::vector<std::string>& texts);  // throws UsageError
//   static std::string write(const Value& value);                    // the default in help; empty: not told
template <typename Value>
struct FlagForm;

using FlagTexts = std::vector<std::string>;

// So many numbers of a unit: "OCTAVES", "X Y Z".
std::string number_names(std::size_t count, std::string_view unit);
// With the fewest digits and a space between; without a fourth that is 0.
std::string format_numbers(std::vector<double> numbers);

// A value that is made of so many numbers.
template <typename Value, std::size_t kCount>
struct NumbersForm {
  static constexpr auto kNumbers = std::same_as<Value, int> ? Flag::Numbers::whole : Flag::Numbers::any;
  static std::string names(std::string_view unit) { return number_names(kCount, unit); }
  static Value read(const std::string& flag, const FlagTexts& texts) {
    if constexpr (std::same_as<Value, int>) {
      return parse_integer(flag, texts[0]);
    } else {
      std::vector<double> v = parse_numbers(flag, texts);
      v.resize(kCount);
      if constexpr (kCount == 1) return v[0];
      if constexpr (kCount == 2) return {v[0], v[1]};
      if constexpr (kCount == 3) return {v[0], v[1], v[2]};
      if constexpr (kCount == 4) return {v[0], v[1], v[2], v[3]};
      if constexpr (kCount == 6) return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    }
  }
  static std::string write(const Value& value) {
    std::vector<double> numbers;
    for_each_number(value, [&](double number) { numbers.push_back(number); });
    return format_numbers(numbers);
  }
};
template <>
struct FlagForm<int> : NumbersForm<int, 1> {};
template <>
struct FlagForm<double> : NumbersForm<double, 1> {};
template <>
struct FlagForm<std::array<double, 2>> : NumbersForm<std::array<double, 2>, 2> {};
template <>
struct FlagForm<std::array<double, 4>> : NumbersForm<std::array<double, 4>, 4> {};
template <>
struct FlagForm<Vec<3>> : NumbersForm<Vec<3>, 3> {};
template <>
struct FlagForm<Vec<4>> : NumbersForm<Vec<4>, 4> {};
template <>
struct FlagForm<Box<3>> : NumbersForm<Box<3>, 6> {};

template <>
struct FlagForm<std::uint64_t> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "INTEGER"; }
  static std::uint64_t read(const std::string& flag, const FlagTexts& texts) {
    return parse_unsigned(flag, texts[0]);
  }
  static std::string write(std::uint64_t value) { return std::to_string(value); }
};

// A name, which may not be empty.
template <>
struct FlagForm<std::string> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "NAME"; }
  static std::string read(const std::string& flag, const FlagTexts& texts) {
    return texts[0].empty() ? throw UsageError(flag + " is empty; it must be a name") : texts[0];
  }
  static std::string write(const std::string& value) { return value; }
};

template <typename Value>
requires requires {
  FlagForm<Value>::kNumbers;
}
struct FlagForm<std::optional<Value>> : FlagForm<Value> {
  static std::string write(const std::optional<Value>& value) {
    return value ? FlagForm<Value>::write(*value) : std::string();
  }
};

}  // namespace solidnoise
