#pragma once

#include <concepts>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/core/fields.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/json_schema.h"

namespace solidnoise {

// The JSON form of structs with a table of fields (core/fields.h): written, read and described from it.

// The form of a value that is neither a number, a word, a text, nor a struct with a table, nor several of
// these: to be specialised beside its type, with
//   static Json write(const Value& value);
//   static void read(JsonReader& reader, const std::string& key, Value& value);  // no key: leaves it
//   static Json schema();  // or schema(const Interval& allowed), of numbers
template <typename Value>
struct JsonForm;

template <typename Value>
concept HasJsonForm = requires(const Value& value) {
  JsonForm<Value>::write(value);
};

template <typename Type>
inline constexpr bool is_vector = false;
template <typename Item>
inline constexpr bool is_vector<std::vector<Item>> = true;
template <typename Type>
concept IsVectorOfStructs = is_vector<Type> && HasFields<typename Type::value_type>;

template <typename Type>
inline constexpr bool is_optional = false;
template <typename Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

template <HasFields Struct>
void write_fields(const Struct& object, Json& json);

template <typename Value>
Json json_of(const Value& value) {
  if constexpr (HasJsonForm<Value>) {
    return JsonForm<Value>::write(value);
  } else if constexpr (HasFields<Value>) {
    Json json = Json::object();
    write_fields(value, json);
    return json;
  } else if constexpr (is_vector<Value>) {
    Json json = Json::array();
    for (const auto& item : value) json.push_back(json_of(item));
    return json;
  } else if constexpr (std::constructible_from<Json, Value>) {
    return value;
  } else {
    Json json = Json::array();
    for_each_number(value, [&](double number) { json.push_back(number); });
    return json;
  }
}

// Adds the fields to an object. An optional value that is not there has no key.
template <HasFields Struct>
void write_fields(const Struct& object, Json& json) {
  for_each_field(object, [&](const auto& field, const auto& owner) {
    if (field.is_written && !field.is_written(owner)) return;
    const auto& value = field.get(owner);
    using Value = std::remove_cvref_t<decltype(value)>;
    const std::string key(field.name);
    if constexpr (std::is_enum_v<Value>) {
      json[key] = name_of(field.allowed, value);
    } else if constexpr (is_optional<Value>) {
      if (value) json[key] = json_of(*value);
    } else {
      json[key] = json_of(value);
    }
  });
}

template <HasFields Struct>
void read_fields(JsonReader& reader, Struct& object);

template <typename Value>
void read_value(JsonReader& reader, const std::string& key, Value& value) {
  if constexpr (HasJsonForm<Value>) {
    JsonForm<Value>::read(reader, key, value);
  } else if constexpr (HasFields<Value>) {
    if (auto object = reader.object(key)) {
      read_fields(*object, value);
      object->finish();
      if constexpr (requires { value.validate(); }) object->validate(value);
    }
  } else if constexpr (is_optional<Value>) {
    typename Value::value_type read{};
    read_value(reader, key, read);
    if (reader.has(key)) value = std::move(read);
  } else if constexpr (IsVectorOfStructs<Value>) {
    for (JsonReader& object : reader.objects(key)) {
      read_fields(object, value.emplace_back());
      object.finish();
    }
  } else {
    reader.read(key, value);
  }
}

// Reads what keys there are, each within its range. The caller goes on with further keys, finish() and
// validate().
template <HasFields Struct>
void read_fields(JsonReader& reader, Struct& object) {
  for_each_field(object, [&](const auto& field, auto& owner) {
    auto value = field.get(owner);
    const std::string key(field.name);
    if (!field.other.empty()) reader.refuse_both(std::string(field.other), key);
    if constexpr (std::is_enum_v<decltype(value)>) {
      reader.read(key, field.allowed, value);
    } else {
      read_value(reader, key, value);
    }
    if constexpr (std::same_as<std::remove_cvref_t<decltype(field.allowed)>, Interval>) {
      const auto check = [&](double number) {
        require(reader.path_of(key), number, field.allowed, field.unit);
      };
      if (reader.has(key)) for_each_number(value, check);
    }
    field.set(owner, std::move(value));
  });
}

template <HasFields Struct>
Json schema_of();

template <typename Value>
Json schema_of_value(const Interval& allowed = {}) {
  if constexpr (requires { JsonForm<Value>::schema(allowed); }) {
    return JsonForm<Value>::schema(allowed);
  } else if constexpr (HasJsonForm<Value>) {
    return JsonForm<Value>::schema();
  } else if constexpr (HasFields<Value>) {
    return schema_of<Value>();
  } else if constexpr (is_optional<Value> || is_vector<Value>) {
    using Item = typename Value::value_type;
    const Json item = schema_of_value<Item>(allowed);
    if constexpr (is_optional<Value>) return item;
    Json array{{"type", "array"}, {"items", item}};
    if constexpr (HasFields<Item>) array["minItems"] = 1;
    return array;
  } else if constexpr (std::same_as<Value, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::same_as<Value, std::string>) {
    return {{"type", "string"}};
  } else if constexpr (std::is_integral_v<Value>) {
    return integer_schema(allowed, std::is_unsigned_v<Value>);
  } else if constexpr (std::is_floating_point_v<Value>) {
    return number_schema(allowed);
  } else {
    std::size_t count = 0;
    for_each_number(Value{}, [&](double) { ++count; });
    return numbers_schema(allowed, count);
  }
}

// The schema of an object with these keys, with their defaults. Others are refused unless the caller adds
// them to "properties".
template <HasFields Struct>
Json schema_of() {
  Json properties = Json::object();
  const auto defaults = std::make_unique<Struct>();  // of a large one g++ 12 says that it is not initialised
  for_each_field(*defaults, [&](const auto& field, const auto& owner) {
    const auto& value = field.get(owner);
    using Value = std::remove_cvref_t<decltype(value)>;
    Json& schema = properties[std::string(field.name)];
    constexpr bool is_interval = std::same_as<std::remove_cvref_t<decltype(field.allowed)>, Interval>;
    if constexpr (std::is_enum_v<Value>) {
      schema = words_schema(names_of(field.allowed));
      schema["default"] = name_of(field.allowed, value);
    } else {
      if constexpr (is_interval) {
        schema = schema_of_value<Value>(field.allowed);
      } else {
        schema = schema_of_value<Value>();
      }
      const bool is_there = !field.is_written || field.is_written(owner);
      if constexpr (!is_optional<Value> && !HasFields<Value> && !HasJsonForm<Value>) {
        if (is_there) schema["default"] = json_of(value);
      }
    }
    describe_schema(schema, field.help, field.unit);
  });
  return object_schema(std::move(properties));
}

// One of several structs with tables: the key "type" has its name, which stands at the alternative's place in
// `names`.
template <typename... Structs>
void write_alternative(const std::variant<Structs...>& variant, const std::vector<std::string_view>& names,
                       Json& json) {
  json["type"] = names[variant.index()];
  std::visit([&](const auto& object) { write_fields(object, json); }, variant);
}

template <typename... Structs>
void make_alternative(std::variant<Structs...>& variant, std::size_t index) {
  std::size_t place = 0;
  ((place++ == index ? static_cast<void>(variant = Structs{}) : void()), ...);
}

template <typename... Structs>
void read_alternative(JsonReader& reader, const std::vector<std::string_view>& names,
                      std::variant<Structs...>& variant) {
  make_alternative(variant, reader.read_choice("type", names));
  std::visit([&](auto& object) { read_fields(reader, object); }, variant);
}

// `others`: the schemas of further keys that each may have.
template <typename... Structs>
Json alternatives_schema(std::type_identity<std::variant<Structs...>>,
                         const std::vector<std::string_view>& names, const Json& others = Json::object()) {
  Json alternatives = Json::array();
  std::size_t place = 0;
  const auto add = [&](Json schema) {
    Json properties = Json::object();
    properties["type"] = words_schema({names[place++]});
    properties.update(schema["properties"]);
    properties.update(others);
    schema["properties"] = std::move(properties);
    schema["required"] = {"type"};
    alternatives.push_back(std::move(schema));
  };
  (add(schema_of<Structs>()), ...);
  return {{"oneOf", std::move(alternatives)}};
}

// The form of a variant of structs with tables whose names are those of kNames; to be derived from.
template <typename Variant, const auto& kNames>
struct AlternativesForm {
  static std::vector<std::string_view> names() {
    static_assert(std::variant_size_v<Variant> == std::size(kNames), "name each alternative");
    return {std::begin(kNames), std::end(kNames)};
  }
  static Json write(const Variant& variant) {
    Json json = Json::object();
    write_alternative(variant, names(), json);
    return json;
  }
  static void read(JsonReader& reader, const std::string& key, Variant& variant) {
    auto object = reader.object(key);
    if (!object) return;
    read_alternative(*object, names(), variant);
    object->finish();
    std::visit(
        [&]<typename Struct>(const Struct& read) {
          if constexpr (requires { read.validate(); }) object->validate(read);
        },
        variant);
  }
  static Json schema() { return alternatives_schema(std::type_identity<Variant>(), names()); }
};

}  // namespace solidnoise
