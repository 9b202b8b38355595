#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "solidnoise/core/check.h"
#include "solidnoise/core/choices.h"

namespace solidnoise {

// The table of a struct's fields, from which its JSON form, schema, flags, help, documentation and checks of
// plain ranges are made. It is written once, as a function that is found by the struct's type:
//
//   constexpr auto fields_of(std::type_identity<GaborNoiseOptions>) {
//     using Options = GaborNoiseOptions;
//     return list_fields(
//         field("frequency", &Options::frequency, kPositive, "cycles per world unit", "Principal frequency"),
//         field("weights", &Options::weights, kImpulseWeightChoices, "How an impulse is weighted"),
//         field("seed", &Options::seed, "Another seed makes another noise"),
//         part(&Options::evolution));
//   }
//
// The order is that of the keys in JSON. Defaults are those of a struct made without arguments.

// What is allowed where that is neither an interval nor one of some words.
struct AnyValue {};

// One field. `Member` is a pointer to a member, or an array of those of several numbers that are one field.
// `Allowed` is an Interval (of a number, or of each of several), Choices of an enumeration, or AnyValue.
template <typename Struct, typename Member, typename Allowed>
struct FieldRow {
  std::string_view name;  // in JSON and messages; the flag is --name, with dashes for underscores
  Member member;
  Allowed allowed;
  std::string_view unit;
  std::string_view help;                        // what it is, one line without unit, range and default
  bool (*is_written)(const Struct&) = nullptr;  // whether JSON has it; null: always
  bool has_flag = true;
  std::string_view other{};  // the field in whose place it may be given, but not beside it; empty: none

  constexpr FieldRow written_if(bool (*condition)(const Struct&)) const {
    FieldRow copy = *this;
    copy.is_written = condition;
    return copy;
  }
  constexpr FieldRow in_place_of(std::string_view field) const {
    FieldRow copy = *this;
    copy.other = field;
    return copy;
  }
  constexpr FieldRow without_flag() const {
    FieldRow copy = *this;
    copy.has_flag = false;
    return copy;
  }

  // Numbers that are one field are read and set together, as an array.
  decltype(auto) get(const Struct& object) const {
    if constexpr (std::is_member_pointer_v<Member>) {
      return (object.*member);
    } else {
      std::array<double, std::tuple_size_v<Member>> numbers;
      for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = object.*member[i];
      return numbers;
    }
  }
  template <typename Value>
  void set(Struct& object, Value value) const {
    if constexpr (std::is_member_pointer_v<Member>) {
      object.*member = std::move(value);
    } else {
      for (std::size_t i = 0; i < value.size(); ++i) object.*member[i] = value[i];
    }
  }
};

// The type of a field's value.
template <typename F, typename Struct>
using ValueOf = std::remove_cvref_t<decltype(std::declval<F>().get(std::declval<const Struct&>()))>;

// A number, or several, within an interval.
template <typename Struct, typename Value>
constexpr auto field(std::string_view name, Value Struct::*member, Interval allowed, std::string_view unit,
                     std::string_view help) {
  return FieldRow<Struct, Value Struct::*, Interval>{name, member, allowed, unit, help};
}
template <typename Struct, std::size_t Count>
constexpr auto field(std::string_view name, std::array<double Struct::*, Count> members, Interval allowed,
                     std::string_view unit, std::string_view help) {
  return FieldRow<Struct, std::array<double Struct::*, Count>, Interval>{name, members, allowed, unit, help};
}
// One of some words.
template <typename Struct, typename Enum, std::size_t Count>
constexpr auto field(std::string_view name, Enum Struct::*member, const Choices<Enum, Count>& choices,
                     std::string_view help) {
  return FieldRow<Struct, Enum Struct::*, Choices<Enum, Count>>{name, member, choices, {}, help};
}
// Whatever the type can hold: a yes or no, a text, a seed, a struct with a table of its own.
template <typename Struct, typename Value>
constexpr auto field(std::string_view name, Value Struct::*member, std::string_view help) {
  return FieldRow<Struct, Value Struct::*, AnyValue>{name, member, {}, {}, help};
}

// A struct whose fields stand among those of the struct that it is in.
template <typename Struct, typename Value>
struct PartRow {
  Value Struct::*member;
};
template <typename Struct, typename Value>
constexpr PartRow<Struct, Value> part(Value Struct::*member) {
  return {member};
}

// Fields, parts and other lists of them, one after the other.
template <typename... Items>
constexpr auto list_fields(const Items&... items) {
  [[maybe_unused]] constexpr auto as_list = []<typename Item>(const Item& item) {
    if constexpr (requires { std::tuple_size<Item>::value; }) {
      return item;
    } else {
      return std::tuple(item);
    }
  };
  return std::tuple_cat(as_list(items)...);
}

template <typename Struct>
concept HasFields = requires {
  fields_of(std::type_identity<Struct>());
};

// Calls visit(field, owner) for each field in order; `owner` is the object or the part of it that the field
// is of, so that field.get(owner) is the value.
template <typename Struct, typename Visit>
void for_each_field(Struct&& object, const Visit& visit) {
  const auto visit_item = [&]<typename Item>(const Item& item) {
    if constexpr (requires { item.name; }) {
      visit(item, object);
    } else {
      for_each_field(object.*item.member, visit);
    }
  };
  std::apply([&](const auto&... items) { (visit_item(items), ...); },
             fields_of(std::type_identity<std::remove_cvref_t<Struct>>()));
}

// Calls visit(number) for each number that a value is made of. A struct of some has an overload beside it.
template <typename Value, typename Visit>
void for_each_number(const Value& value, const Visit& visit) {
  if constexpr (std::is_arithmetic_v<Value>) {
    visit(static_cast<double>(value));
  } else if constexpr (requires { value.has_value(); }) {
    if (value) for_each_number(*value, visit);
  } else if constexpr (requires { value.size(); }) {
    for (const auto& number : value) visit(number);
  } else {
    for (int axis = 0; axis < Value::length(); ++axis) visit(value[axis]);
  }
}

// Throws std::invalid_argument for a number that its field does not allow, also for one of a struct that has
// a table but no validate() of its own: "direction.smooth is -1; ...".
template <HasFields Struct>
void require_fields(const Struct& object, const std::string& path = {}) {
  for_each_field(object, [&](const auto& field, const auto& owner) {
    const auto& value = field.get(owner);
    using Value = std::remove_cvref_t<decltype(value)>;
    const std::string name = path + std::string(field.name);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field.allowed)>, Interval>) {
      for_each_number(value, [&](double number) { require(name, number, field.allowed, field.unit); });
    } else if constexpr (HasFields<Value> && !requires { value.validate(); }) {
      require_fields(value, name + ".");
    }
  });
}

}  // namespace solidnoise
