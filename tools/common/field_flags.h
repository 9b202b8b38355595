#pragma once

#include <algorithm>
#include <cctype>
#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/flag_form.h"
#include "common/flag_set.h"
#include "common/parse_value.h"
#include "solidnoise/core/fields.h"

namespace solidnoise {

// Flags made from tables of fields (core/fields.h): name, help, unit, range and default are the table's. A
// number out of its range is refused by the flag's name before anything is done.

// "--smooth-radius" of the field "smooth_radius".
std::string flag_of(std::string_view field);

// "Width of the band at half amplitude [octaves; 0.05 to 4]".
std::string help_of(std::string_view help, std::string_view unit, const Interval& allowed);

// Fields that can have a flag.
template <typename Value>
concept HasFlagForm = std::is_enum_v<Value> || std::same_as<Value, bool> || requires {
  FlagForm<Value>::kNumbers;
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

// How a flag of a field is declared: under which name, and with which words before the table's.
struct FieldFlag {
  std::string name;
  std::string before{};
};

// Declares the flag of a field of `Owner`. get() is its default, as it is when help is asked for; set(value)
// is what the flag does.
template <typename Owner, typename F, typename Get, typename Set>
void declare_field(FlagSet& flags, const F& field, const FieldFlag& flag, const Get& get, const Set& set) {
  using Value = ValueOf<F, Owner>;
  constexpr bool has_interval = std::same_as<std::remove_cvref_t<decltype(field.allowed)>, Interval>;
  std::string help = flag.before + std::string(field.help);
  if constexpr (std::same_as<Value, bool>) {
    const bool is_on = field.get(Owner{});
    const std::string name = is_on ? "--no-" + flag.name.substr(2) : flag.name;
    if (is_on) {
      help.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(help.front())));
      help.insert(0, "Do not ");
    }
    flags.toggle(name, help, [=] { set(!is_on); });
  } else if constexpr (std::is_enum_v<Value>) {
    const auto choices = field.allowed;
    flags.choice(flag.name, names_of(choices), help, [=](std::size_t i) { set(choices[i].value); }).standard =
        [=] { return std::string(name_of(choices, get())); };
  } else {
    Interval allowed;
    if constexpr (has_interval) allowed = field.allowed;
    const auto read = [set, name = flag.name, allowed,
                       unit = field.unit](const std::vector<std::string>& texts) {
      const Value value = FlagForm<Value>::read(name, texts);
      if constexpr (has_interval) {
        for_each_number(value, [&](double number) { require(name, number, allowed, unit); });
      }
      set(value);
    };
    flags.add({flag.name, FlagForm<Value>::names(field.unit), help_of(help, field.unit, allowed), read,
               FlagForm<Value>::kNumbers, [get] { return FlagForm<Value>::write(get()); }});
  }
}

// Declares the flag of a field that is found by its name; set(value) is what it does.
template <HasFields Struct, typename Set>
void declare_field(FlagSet& flags, const Struct& object, std::string_view field_name, const FieldFlag& flag,
                   const Set& set) {
  for_each_field(object, [&]<typename F, typename Owner>(const F& field, const Owner& owner) {
    using Value = ValueOf<F, Owner>;
    if constexpr (HasFlagForm<Value> && std::invocable<Set, Value>) {
      if (field.name != field_name) return;
      declare_field<Owner>(
          flags, field, flag, [field, &owner] { return field.get(owner); }, set);
    }
  });
}
template <HasFields Struct, typename Set>
void declare_field(FlagSet& flags, const Struct& object, std::string_view name, const Set& set) {
  declare_field(flags, object, name, {flag_of(name)}, set);
}

// Declares the flags of the fields of a struct, of all or of those with these names; they set it.
template <HasFields Struct>
void declare_fields(FlagSet& flags, Struct& object, std::initializer_list<std::string_view> names = {}) {
  for_each_field(object, [&]<typename F, typename Owner>(const F& field, Owner& owner) {
    if constexpr (HasFlagForm<ValueOf<F, Owner>>) {
      const bool is_named = std::find(names.begin(), names.end(), field.name) != names.end();
      if (names.size() > 0 ? !is_named : !field.has_flag) return;
      declare_field<Owner>(
          flags, field, {flag_of(field.name)}, [field, &owner] { return field.get(owner); },
          [field, &owner](const ValueOf<F, Owner>& value) { field.set(owner, value); });
    }
  });
}

// Sets the field of a name, if there is one with a flag, of the same type.
template <typename Struct, typename Value>
bool set_field(Struct& object, std::string_view name, const Value& value) {
  bool is_set = false;
  for_each_flag(object, [&]<typename Owner>(const auto& field, Owner& owner) {
    if constexpr (std::same_as<ValueOf<decltype(field), Owner>, Value>) {
      if (field.name != name) return;
      field.set(owner, value);
      is_set = true;
    }
  });
  return is_set;
}

// What flags of the alternatives of a variant are like.
struct AlternativeFlags {
  std::vector<std::string_view> names;  // of the alternatives
  const char* refusal;                  // a format of the flag and the name of the alternative that lacks it
  std::vector<std::string_view> without{};  // fields that are to have no flag
};

// Declares the flags of the fields of all alternatives, which act on that which the variant holds when they
// are applied; what it has no use for is refused then. Returns the flags' names.
template <typename... Structs>
std::vector<std::string> declare_alternatives(FlagSet& flags, std::variant<Structs...>& variant,
                                              const AlternativeFlags& how) {
  const auto names_with = [&how](std::string_view name) {
    std::vector<std::string_view> names;
    std::size_t index = 0;
    const auto visit = [&](const auto& alternative) {
      for_each_flag(alternative, [&](const auto& field, const auto&) {
        if (field.name == name) names.push_back(how.names[index]);
      });
      ++index;
    };
    (visit(Structs{}), ...);
    return names;
  };
  std::vector<std::string> declared;
  const auto declare = [&]<typename Owner>(const auto& field, const Owner&) {
    using Value = ValueOf<decltype(field), Owner>;
    const std::string flag = flag_of(field.name);
    const bool is_out = std::find(how.without.begin(), how.without.end(), field.name) != how.without.end();
    if (is_out || std::find(declared.begin(), declared.end(), flag) != declared.end()) return;
    declared.push_back(flag);
    const auto names = names_with(field.name);
    const std::string before =
        names.size() == sizeof...(Structs) ? "" : fmt::format("{}: ", fmt::join(names, ", "));
    const auto get = [field, &variant] {
      Value value = field.get(Owner{});
      const auto find = [&](const auto& present) {
        for_each_flag(present, [&]<typename Of>(const auto& other, const Of& of) {
          if constexpr (std::same_as<ValueOf<decltype(other), Of>, Value>) {
            if (other.name == field.name) value = other.get(of);
          }
        });
      };
      std::visit(find, variant);
      return value;
    };
    const auto set = [flag, name = field.name, how, &variant](const Value& value) {
      const auto set_present = [&](auto& present) { return set_field(present, name, value); };
      if (std::visit(set_present, variant)) return;
      throw UsageError(fmt::format(fmt::runtime(how.refusal), flag, how.names[variant.index()]));
    };
    declare_field<Owner>(flags, field, {flag, before}, get, set);
  };
  (for_each_flag(Structs{}, declare), ...);
  return declared;
}

}  // namespace solidnoise
