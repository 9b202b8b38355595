#include "solidnoise/recipe/json.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace solidnoise {
namespace {

// Objects nested deeper than any recipe are refused before they cost memory.
constexpr int kMaxDepth = 32;

void append(std::string& text, const Json& json, int indent) {
  const bool is_flat =
      std::none_of(json.begin(), json.end(), [](const Json& v) { return v.is_structured(); });
  if (!json.is_structured() || json.empty()) {
    text += json.dump();
  } else if (json.is_array() && is_flat) {
    text += '[';
    for (std::size_t i = 0; i < json.size(); ++i) text += (i ? ", " : "") + json[i].dump();
    text += ']';
  } else {
    const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
    text += json.is_array() ? '[' : '{';
    const char* separator = "\n";
    for (const auto& item : json.items()) {
      text += separator + margin;
      if (json.is_object()) text += Json(item.key()).dump() + ": ";
      append(text, item.value(), indent + 2);
      separator = ",\n";
    }
    text += '\n' + std::string(static_cast<std::size_t>(indent), ' ') + (json.is_array() ? ']' : '}');
  }
}

// The library's message without its own prefix, "[json.exception.parse_error.101] parse error ".
std::string plain_message(const std::string& message) {
  const std::size_t end_of_prefix = message.find("] ");
  return end_of_prefix == std::string::npos ? message : message.substr(end_of_prefix + 2);
}

}  // namespace

Json parse_json(std::string_view text) {
  std::vector<std::set<std::string>> keys_of_open_objects;
  const auto refuse_repeated_keys = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kMaxDepth) throw std::invalid_argument("nested too deeply to be a recipe");
    if (event == Json::parse_event_t::object_start) keys_of_open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_of_open_objects.pop_back();
    if (event == Json::parse_event_t::key && !keys_of_open_objects.back().insert(parsed).second) {
      throw std::invalid_argument(fmt::format("the key {} is given twice", parsed.dump()));
    }
    return true;
  };
  try {
    return Json::parse(text, refuse_repeated_keys);
  } catch (const Json::exception& error) {
    throw std::invalid_argument(plain_message(error.what()));
  }
}

std::string format_json(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + '\n';
}

}  // namespace solidnoise
