#include "solidnoise/recipe/json_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/choices.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise {
namespace {

// Names one after the other, the first dozen of them.
std::string listed(std::span<const std::string_view> names) {
  constexpr std::size_t kMost = 12;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", fmt::join(names.first(kMost), ", "), names.size() - kMost);
}

}  // namespace

JsonReader::JsonReader(const Json& object, std::string path) : object_(object), path_(std::move(path)) {
  if (object.is_object()) return;
  const std::string name = path_.empty() ? "the recipe" : path_;
  throw std::invalid_argument(fmt::format("{} is {}; it must be an object", name, shown(object)));
}

std::vector<std::string> JsonReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& item : object_.items()) keys.push_back(item.key());
  return keys;
}

void JsonReader::read(const std::string& key, double& value) {
  const Json* const json = find(key);
  if (!json) return;
  if (!json->is_number()) refuse(key, "a number");
  value = json->get<double>();
}

void JsonReader::read(const std::string& key, int& value) {
  const Json* const json = find(key);
  if (!json) return;
  constexpr std::int64_t kLowest = std::numeric_limits<int>::lowest();
  constexpr std::int64_t kHighest = std::numeric_limits<int>::max();
  const bool fits = json->is_number_unsigned()  ? json->get<std::uint64_t>() <= std::uint64_t{kHighest}
                    : json->is_number_integer() ? json->get<std::int64_t>() >= kLowest
                                                : false;
  if (!fits) refuse(key, "a whole number");
  value = json->get<int>();
}

void JsonReader::read(const std::string& key, std::uint64_t& value) {
  const Json* const json = find(key);
  if (!json) return;
  const bool is_zero = json->is_number_integer() && json->get<std::int64_t>() == 0;  // -0, too
  if (!json->is_number_unsigned() && !is_zero) refuse(key, "a whole number from 0 to 18446744073709551615");
  value = json->get<std::uint64_t>();
}

void JsonReader::read(const std::string& key, bool& value) {
  const Json* const json = find(key);
  if (!json) return;
  if (!json->is_boolean()) refuse(key, "true or false");
  value = json->get<bool>();
}

void JsonReader::read(const std::string& key, std::string& value) {
  const Json* const json = find(key);
  if (!json) return;
  if (!json->is_string()) refuse(key, "a text");
  value = json->get<std::string>();
}

void JsonReader::read(const std::string& key, std::optional<double>& value) {
  double number = 0.0;
  read(key, number);
  if (has(key)) value = number;
}

void JsonReader::read(const std::string& key, Box<3>& value) {
  std::array<double, 6> corners{value.lower.x, value.lower.y, value.lower.z,
                                value.upper.x, value.upper.y, value.upper.z};
  read_numbers(key, corners.data(), corners.size());
  value = {{corners[0], corners[1], corners[2]}, {corners[3], corners[4], corners[5]}};
}

void JsonReader::read(const std::string& key, std::vector<Vec<2>>& pairs) {
  std::vector<std::vector<double>> rows;
  read_rows(key, 2, "pairs of numbers", rows);
  if (!has(key)) return;
  pairs.clear();
  for (const std::vector<double>& row : rows) pairs.emplace_back(row[0], row[1]);
}

void JsonReader::read(const std::string& key, std::vector<std::string>& texts) {
  const Json* const json = find(key);
  if (!json) return;
  const auto is_text = [](const Json& text) { return text.is_string(); };
  if (!json->is_array() || !std::all_of(json->begin(), json->end(), is_text)) {
    refuse(key, "an array of texts");
  }
  texts = json->get<std::vector<std::string>>();
}

void JsonReader::read_rows(const std::string& key, std::size_t columns, const std::string& what,
                           std::vector<std::vector<double>>& rows) {
  const Json* const json = find(key);
  if (!json) return;
  const auto is_number = [](const Json& number) { return number.is_number(); };
  const auto is_row = [&](const Json& row) {
    return row.is_array() && row.size() == columns && std::all_of(row.begin(), row.end(), is_number);
  };
  if (!json->is_array()) refuse(key, "an array of " + what);
  const auto odd = std::find_if_not(json->begin(), json->end(), is_row);
  if (odd != json->end()) {
    refuse(key, fmt::format("an array of {}, which number {} is not", what, odd - json->begin()));
  }
  rows.clear();
  for (const Json& row : *json) rows.push_back(row.get<std::vector<double>>());
}

void JsonReader::read_range(const std::string& key, double& from, double& to) {
  const Json* const json = find(key);
  if (!json) return;
  if (!json->is_array()) {
    read(key, from);
    to = from;
    return;
  }
  std::array<double, 2> ends{};
  read_numbers(key, ends.data(), ends.size());
  from = ends[0];
  to = ends[1];
}

std::size_t JsonReader::read_choice(const std::string& key, const std::vector<std::string_view>& names) {
  const Json* const json = find(key);
  const std::string allowed = fmt::format("one of {}", fmt::join(names, ", "));
  if (!json) throw std::invalid_argument(fmt::format("{} is missing; it must be {}", path_of(key), allowed));
  if (!json->is_string()) refuse(key, allowed);
  const auto found = std::find(names.begin(), names.end(), json->get_ref<const std::string&>());
  if (found == names.end()) refuse(key, allowed);
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<JsonReader> JsonReader::object(const std::string& key) {
  const Json* const json = find(key);
  if (!json) return std::nullopt;
  return JsonReader(*json, path_of(key));
}

std::vector<JsonReader> JsonReader::objects(const std::string& key) {
  std::vector<JsonReader> readers;
  const Json* const json = find(key);
  if (!json) return readers;
  if (!json->is_array() || json->empty()) refuse(key, "an array of objects, of one at least");
  for (std::size_t i = 0; i < json->size(); ++i) {
    readers.emplace_back((*json)[i], fmt::format("{}[{}]", path_of(key), i));
  }
  return readers;
}

void JsonReader::refuse_both(const std::string& key, const std::string& other) const {
  if (!has(key) || !has(other)) return;
  throw std::invalid_argument(
      fmt::format("{} and {} contradict each other; give one of them", path_of(key), other));
}

void JsonReader::finish() const {
  for (const auto& item : object_.items()) {
    if (std::find(known_keys_.begin(), known_keys_.end(), item.key()) != known_keys_.end()) continue;
    const std::string quoted = shown(item.key());
    const std::string path = path_of(quoted.substr(1, quoted.size() - 1 - (quoted.ends_with('"') ? 1 : 0)));
    const std::vector<std::string_view> known(known_keys_.begin(), known_keys_.end());
    const std::string_view nearest = nearest_word(item.key(), known);
    throw std::invalid_argument(nearest.empty()
                                    ? fmt::format("{} is unknown; the keys here are {}", path, listed(known))
                                    : fmt::format("{} is unknown; did you mean {}?", path, nearest));
  }
}

std::string JsonReader::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

const Json* JsonReader::find(const std::string& key) {
  note(key);
  const auto found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

void JsonReader::note(const std::string& key) {
  if (std::find(known_keys_.begin(), known_keys_.end(), key) == known_keys_.end()) known_keys_.push_back(key);
}

void JsonReader::read_numbers(const std::string& key, double* values, std::size_t count) {
  const Json* const json = find(key);
  if (!json) return;
  const bool are_numbers =
      json->is_array() && json->size() == count &&
      std::all_of(json->begin(), json->end(), [](const Json& component) { return component.is_number(); });
  if (!are_numbers) refuse(key, fmt::format("an array of {} numbers", count));
  for (std::size_t i = 0; i < count; ++i) values[i] = (*json)[i].get<double>();
}

void JsonReader::refuse(const std::string& key, const std::string& allowed) const {
  throw std::invalid_argument(
      fmt::format("{} is {}; it must be {}", path_of(key), shown(object_.at(key)), allowed));
}

Json recipe_header() {
  Json json = Json::object();
  json["solidnoise"] = kRecipeVersion;
  json["algorithm"] = kAlgorithmVersion;
  return json;
}

void read_recipe_header(JsonReader& reader) {
  if (!reader.has("solidnoise")) {
    throw std::invalid_argument(
        fmt::format("\"solidnoise\": {} is missing; this is no recipe", kRecipeVersion));
  }
  int version = 0;
  reader.read("solidnoise", version);
  if (version < 1 || version > kRecipeVersion) {
    throw std::invalid_argument(fmt::format(
        "solidnoise is {}; this program reads recipes of versions 1 to {}", version, kRecipeVersion));
  }
  int algorithm = kAlgorithmVersion;
  reader.read("algorithm", algorithm);
  std::string schema;  // where editors find what keys there are
  reader.read("$schema", schema);
}

int algorithm_of(const Json& json) {
  JsonReader reader(json);
  int algorithm = kAlgorithmVersion;
  reader.read("algorithm", algorithm);
  return algorithm;
}

}  // namespace solidnoise
