#include "solidnoise/recipe/json.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/printable.h"

namespace solidnoise {
namespace {

// Objects that are nested deeper, or have more keys, than any recipe are refused before they cost memory or
// time: keys that keep their order are looked up one by one.
constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxKeys = 1024;
constexpr std::size_t kMaxObjects = 4096;  // each a grid, layer or band, which costs memory and time

// Where a parser reads; which character it read last is told to `last`.
struct TextReader {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** last;

  reference operator*() const { return *(*last = at); }
  TextReader& operator++() {
    ++at;
    return *this;
  }
  bool operator==(const TextReader& other) const { return at == other.at; }
};

bool has_control_character(std::string_view text) {
  return std::ranges::any_of(text,
                             [](char c) { return c >= 0 && c < ' ' && c != '\n' && c != '\r' && c != '\t'; });
}

// Goes through a text without keeping what is in it, but the keys of open objects.
class KeyCheck final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  // Names of files and grids end at some of these, or break what they are written into.
  bool string(string_t& text) override {
    if (!has_control_character(text)) return true;
    throw std::invalid_argument(
        fmt::format("\"{}\" has a control character, which no text may", printable(text)));
  }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    if (++objects_ > kMaxObjects) throw std::invalid_argument("too many objects to be a recipe");
    return open();
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_array() override { return close(); }
  // What else is wrong with the text is said by the parser.
  bool parse_error(std::size_t, const std::string& token, const Json::exception& error) override {
    constexpr int kOverflow = 406;
    if (error.id != kOverflow) return false;
    constexpr double kMost = std::numeric_limits<double>::max();
    throw std::invalid_argument(fmt::format("{} is no number that fits; it must be between {} and {}",
                                            printable(token), -kMost, kMost));
  }

  bool key(string_t& name) override {
    std::unordered_set<std::string>& keys = keys_of_open_.back();
    if (!keys.insert(name).second) {
      throw std::invalid_argument(fmt::format("the key {} is given twice", shown(name)));
    }
    if (keys.size() > kMaxKeys) throw std::invalid_argument("too many keys in one object to be a recipe");
    return true;
  }

 private:
  bool open() {
    keys_of_open_.emplace_back();
    if (keys_of_open_.size() > kMaxDepth) {
      throw std::invalid_argument("nested too deeply to be a recipe");
    }
    return true;
  }
  bool close() {
    keys_of_open_.pop_back();
    return true;
  }

  std::size_t objects_ = 0;
  std::vector<std::unordered_set<std::string>> keys_of_open_;
};

// Walks through a text that is known to be JSON.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {}

  std::size_t place() const { return at_; }

  // Goes to the value under a key, or of an index, of what it stands at. False, and anywhere, if there is
  // none.
  bool enter(std::string_view key, std::size_t& place_of_key) {
    if (!open('{')) return false;
    while (next('}')) {
      place_of_key = at_;
      const bool found = quoted() == key;
      skip_space();
      ++at_;  // the colon
      skip_space();
      if (found) return true;
      skip_value();
    }
    return false;
  }
  bool enter(std::size_t index) {
    if (!open('[')) return false;
    for (; next(']'); --index) {
      if (index == 0) return true;
      const std::size_t before = at_;
      skip_value();
      if (at_ == before) return false;
    }
    return false;
  }

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  // And comments.
  void skip_space() {
    for (;;) {
      at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
      const std::string_view begin = text_.substr(at_, 2);
      if (begin == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (begin == "/*") {
        at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
      } else {
        return;
      }
    }
  }

  bool open(char bracket) {
    skip_space();
    if (here() != bracket) return false;
    ++at_;
    return true;
  }
  // Whether there is another item before the closing bracket; goes to it.
  bool next(char bracket) {
    skip_space();
    if (here() == ',') ++at_;
    skip_space();
    return at_ < text_.size() && here() != bracket;
  }
  std::string_view quoted() {
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    return text_.substr(begin, at_++ - begin);
  }
  void skip_value() {
    int depth = 0;
    do {
      skip_space();
      const char c = here();
      if (c == '"') {
        quoted();
        continue;
      }
      if (depth == 0 && (c == ',' || c == ']' || c == '}')) return;
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      ++at_;
    } while (at_ < text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

// Where the innermost thing of a path that exists begins; nothing if there is none.
std::optional<std::size_t> find_path(std::string_view text, std::string_view path) {
  Walker walker(text);
  std::optional<std::size_t> place;
  while (!path.empty()) {
    if (path[0] == '[') {
      const std::size_t end = path.find(']');
      if (end == std::string_view::npos) break;
      std::size_t index = 0;
      std::from_chars(path.data() + 1, path.data() + end, index);
      if (!walker.enter(index)) break;
      place = walker.place();
      path.remove_prefix(end + 1);
    } else {
      if (path[0] == '.') path.remove_prefix(1);
      const std::size_t end = std::min(path.find_first_of(".["), path.size());
      std::size_t key = 0;
      if (!walker.enter(path.substr(0, end), key)) break;
      place = key;
      path.remove_prefix(end);
    }
  }
  return place;
}

std::string at_line(std::string_view text, std::size_t place, std::string_view message) {
  const std::string_view before = text.substr(0, place);
  return fmt::format("line {}: {}", std::count(before.begin(), before.end(), '\n') + 1, message);
}

// A value or a key, with what no terminal may be shown as \u009b.
std::string dumped(const Json& json) {
  const std::string text = json.dump();
  constexpr bool kAscii = true;
  return printable(text, std::string::npos) == text ? text : json.dump(-1, ' ', kAscii);
}

void append(std::string& text, const Json& json, int indent) {
  const bool is_flat =
      std::none_of(json.begin(), json.end(), [](const Json& v) { return v.is_structured(); });
  if (!json.is_structured() || json.empty()) {
    text += dumped(json);
  } else if (json.is_array() && is_flat) {
    text += '[';
    for (std::size_t i = 0; i < json.size(); ++i) text += (i ? ", " : "") + dumped(json[i]);
    text += ']';
  } else {
    const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
    text += json.is_array() ? '[' : '{';
    const char* separator = "\n";
    for (const auto& item : json.items()) {
      text += separator + margin;
      if (json.is_object()) text += dumped(item.key()) + ": ";
      append(text, item.value(), indent + 2);
      separator = ",\n";
    }
    text += '\n' + std::string(static_cast<std::size_t>(indent), ' ') + (json.is_array() ? ']' : '}');
  }
}

// "line 3, column 7: this is no JSON", of the byte, from 1, at which a parser stopped.
std::string say_no_json(std::string_view text, std::size_t byte) {
  const std::string_view read = text.substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = std::count(read.begin(), read.end(), '\n') + 1;
  const std::string_view of_line = read.substr(read.rfind('\n') + 1);
  const std::string place = fmt::format("line {}, column {}", line, of_line.size() + 1);
  if (read.size() == text.size()) return place + ": the JSON is not complete";
  if (of_line.empty()) return place + ": this is no JSON";
  constexpr std::size_t kMostQuoted = 20;
  const std::string_view before = of_line.substr(std::max(of_line.size(), kMostQuoted) - kMostQuoted);
  return fmt::format("{}: this is no JSON, after '{}'", place, printable(before));
}

}  // namespace

Json parse_json(std::string_view text) {
  constexpr bool kIgnoreComments = true;
  const char* last = text.data();
  const TextReader begin{text.data(), &last};
  const TextReader end{text.data() + text.size(), &last};
  try {
    KeyCheck check;
    Json::sax_parse(begin, end, &check, Json::input_format_t::json, /*strict=*/true, kIgnoreComments);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(at_line(text, static_cast<std::size_t>(last - text.data()), error.what()));
  }
  try {
    return Json::parse(begin, end, nullptr, /*allow_exceptions=*/true, kIgnoreComments);
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument(say_no_json(text, error.byte));
  }
}

std::string with_line(std::string_view text, const std::string& message) {
  const std::string_view path = std::string_view(message).substr(0, message.find(' '));
  const std::optional<std::size_t> place = find_path(text, path);
  if (!place) return message;
  return at_line(text, *place, message);
}

std::string shown(const Json& json) {
  return printable(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void require_utf8(const Json& json, const std::string& path) {
  if (json.is_string()) {
    try {
      json.dump();
    } catch (const Json::type_error&) {
      throw std::invalid_argument(
          fmt::format("{} is {}; it must be UTF-8 to be in a recipe", path, shown(json)));
    }
    if (has_control_character(json.get_ref<const std::string&>())) {
      throw std::invalid_argument(
          fmt::format("{} is {}; it must have no control character", path, shown(json)));
    }
  }
  if (!json.is_structured()) return;
  for (const auto& item : json.items()) {
    const std::string step = json.is_array() ? fmt::format("[{}]", item.key()) : item.key();
    require_utf8(item.value(), json.is_array() || path.empty() ? path + step : path + '.' + step);
  }
}

std::string format_json(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + '\n';
}

}  // namespace solidnoise
