#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace solidnoise {

// Takes the next word off the front of `text`; empty if there is none.
std::string_view take_word(std::string_view& text);

// Takes off what is blank at both ends.
std::string_view trim(std::string_view text);

// The number that is the whole of `word`, in the "C" locale; a plus sign may stand before it.
template <typename Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

// The same for doubles, where a number too small for any is 0 and one too large is infinite.
std::optional<double> parse_double(std::string_view word);

// Whether a decimal number has more digits than a float32 can need (9), or is too large for one.
bool needs_float64(std::string_view word, double number);

// The lines of a text file, for a reader that must say in which one the trouble is.
class TextLines {
 public:
  // Line numbers go on from `lines_before`.
  TextLines(std::string_view text, const std::string& name, std::size_t lines_before = 0)
      : rest_(text), name_(name), number_(lines_before) {}

  // Moves on; false at the end. Line ends are not part of the line.
  bool next();
  // Moves on to the next line that has more than blanks and a comment, which begins with `mark` and is cut
  // off.
  bool next_filled(char mark);

  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  // of this line; the first is 1
  std::string_view rest() const { return rest_; }
  const std::string& name() const { return name_; }

  // Throws std::runtime_error: NAME:LINE: what.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string_view rest_;
  std::string_view line_;
  const std::string& name_;
  std::size_t number_;
};

}  // namespace solidnoise
