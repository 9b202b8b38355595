#include "common/parse_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/run_tool.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {

void refuse_value(const std::string& flag, const std::string& text, std::string_view allowed) {
  throw UsageError(
      fmt::format("{} is {}; it must be {}", flag, text.empty() ? "empty" : printable(text), allowed));
}

namespace {

// Reads the text from `begin` as far as it is a value; returns where it stopped, or nullptr if it is none.
template <typename Value>
const char* read_value(const std::string& text, Value& value) {
  const char* const begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  return error == std::errc() ? end : nullptr;
}

template <typename Value>
Value parse_whole(const std::string& flag, const std::string& text, std::string_view allowed) {
  Value value{};
  if (read_value(text, value) != text.data() + text.size()) refuse_value(flag, text, allowed);
  return value;
}

}  // namespace

double parse_number(const std::string& flag, const std::string& text) {
  const double value = parse_whole<double>(flag, text, "a number");
  if (!std::isfinite(value)) refuse_value(flag, text, "a finite number");
  return value;
}

int parse_integer(const std::string& flag, const std::string& text) {
  return parse_whole<int>(flag, text, "a whole number");
}

std::uint64_t parse_unsigned(const std::string& flag, const std::string& text) {
  return parse_whole<std::uint64_t>(flag, text, "a whole number from 0 to 18446744073709551615");
}

std::vector<double> parse_numbers(const std::string& flag, const std::vector<std::string>& texts) {
  std::vector<double> numbers;
  for (const std::string& text : texts) numbers.push_back(parse_number(flag, text));
  return numbers;
}

std::size_t parse_word(const std::string& flag, const std::string& text,
                       const std::vector<std::string_view>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) refuse_value(flag, text, fmt::format("one of {}", fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

std::uint64_t parse_bytes(const std::string& flag, const std::string& text) {
  constexpr std::string_view kAllowed = "a number of bytes, such as 500M or 8G";
  double number = 0.0;
  const char* const end = read_value(text, number);
  if (!end || !std::isfinite(number) || number <= 0.0) refuse_value(flag, text, kAllowed);

  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (!unit.empty() && (unit.back() == 'B' || unit.back() == 'b')) unit.remove_suffix(1);
  if (!unit.empty() && unit.back() == 'i') unit.remove_suffix(1);
  constexpr std::string_view kPowersOf1024 = "KMGT";
  double scale = 1.0;
  if (!unit.empty()) {
    const std::size_t power = kPowersOf1024.find(static_cast<char>(unit[0] & ~0x20));
    if (unit.size() != 1 || power == std::string_view::npos) refuse_value(flag, text, kAllowed);
    scale = std::pow(1024.0, static_cast<double>(power + 1));
  }
  if (number * scale >= 0x1p63) refuse_value(flag, text, "below 8 million TiB");
  return static_cast<std::uint64_t>(number * scale);
}

namespace {

constexpr std::size_t kMostFrames = 1'000'000;
constexpr int kMostDigits = 9;

// Takes a whole number without a sign off the front of `text`.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

// Where a number goes: `length` letters from `begin`, at least `digits` of it.
struct Place {
  std::size_t begin = 0;
  std::size_t length = 0;
  int digits = 1;
};

// The first place at or after `from`.
std::optional<Place> find_place(const std::string& name, std::size_t from) {
  for (std::size_t i = name.find_first_of("#%", from); i != std::string::npos;
       i = name.find_first_of("#%", i + 1)) {
    if (name[i] == '#') {
      const std::size_t end = std::min(name.find_first_not_of('#', i), name.size());
      return Place{i, end - i, static_cast<int>(end - i)};
    }
    std::string_view rest = std::string_view(name).substr(i + 1);
    const int digits = take_number(rest).value_or(1);
    if (take(rest, 'd')) return Place{i, name.size() - i - rest.size(), std::max(digits, 1)};
  }
  return std::nullopt;
}

// The place that a name without its extension ends with.
std::optional<Place> find_last_place(const std::string& stem) {
  std::optional<Place> place = find_place(stem, 0);
  while (place && place->begin + place->length != stem.size())
    place = find_place(stem, place->begin + place->length);
  return place;
}

}  // namespace

std::vector<int> parse_frames(const std::string& flag, const std::string& text) {
  std::string_view rest = text;
  const std::optional<int> first = take_number(rest);
  std::optional<int> last = first;
  std::optional<int> step = 1;
  if (take(rest, '-')) {
    last = take_number(rest);
    if (take(rest, 'x')) step = take_number(rest);
  }
  if (!first || !last || !step || !rest.empty() || *step < 1) {
    refuse_value(flag, text, "frames from 0 on, such as 1001-1048, 1001-1100x2 or 1001");
  }
  if (*last < *first) refuse_value(flag, text, "a frame and one that does not come before it");
  const std::size_t count = static_cast<std::size_t>((*last - *first) / *step) + 1;
  if (count > kMostFrames) refuse_value(flag, text, fmt::format("{} frames at most", kMostFrames));
  std::vector<int> frames(count);
  for (std::size_t i = 0; i < count; ++i) frames[i] = *first + static_cast<int>(i) * *step;
  return frames;
}

bool has_frame_number(const std::string& path) {
  return find_last_place(std::filesystem::path(path).stem().string()).has_value();
}

std::string frame_path(const std::string& flag, const std::string& pattern, int frame) {
  const std::filesystem::path path(pattern);
  const std::string stem = path.stem().string();
  const std::optional<Place> place = find_last_place(stem);
  const std::string example =
      fmt::format("{}.####{}", stem.substr(0, stem.find_first_of(".#%")), path.extension().string());
  if (!place && !find_place(pattern, 0)) {
    throw UsageError(
        fmt::format("{} is {}; of several frames it must have a place for the number, such as {}", flag,
                    pattern, example));
  }
  if (!place || place->digits > kMostDigits) {
    throw UsageError(fmt::format(
        "{} is {}; it must have a place for the frame's number, of at most {} digits, right before the "
        "extension, such as {}",
        flag, pattern, kMostDigits, example));
  }
  const std::string name = fmt::format("{}{:0{}}{}", stem.substr(0, place->begin), frame, place->digits,
                                       path.extension().string());
  return (path.parent_path() / name).string();
}

}  // namespace solidnoise
