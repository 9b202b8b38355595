#include "solidnoise/geometry/check_off.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kMostHandles = std::numeric_limits<std::int32_t>::max();  // of OpenMesh's

class OffCheck {
 public:
  OffCheck(std::string_view bytes, const std::string& name) : lines_(bytes, name) {}

  CheckedOff check() {
    if (!next_line()) throw std::runtime_error(fmt::format("{}: the file holds no mesh", lines_.name()));
    check_keyword();
    check_counts();
    for (index_ = 0; index_ < vertex_count_; ++index_) {
      if (!next_line()) end_early(fmt::format("vertex {} of {}", index_, vertex_count_));
      check_vertex();
    }
    for (index_ = 0; index_ < face_count_; ++index_) {
      if (!next_line()) end_early(fmt::format("face {} of {}", index_, face_count_));
      check_face();
    }
    while (next_line()) has_tail_ = true;
    if (has_surplus_) checked_.notes.push_back("numbers after those of the vertices are dropped");
    if (has_face_colors_) checked_.notes.push_back("the colours of faces are dropped");
    if (has_tail_) checked_.notes.push_back("what follows the last face is ignored");
    return std::move(checked_);
  }

 private:
  // The next line that says something, without its comment.
  bool next_line() {
    while (lines_.next()) {
      const std::size_t comment = lines_.line().find('#');
      text_ = trim(lines_.line().substr(0, comment));
      // Those beside numbers are about these.
      if (comment != std::string_view::npos && (text_.empty() || checked_.positions.empty())) {
        checked_.comments.emplace_back(trim(lines_.line().substr(comment + 1)));
      }
      if (!text_.empty()) return true;
    }
    return false;
  }

  // [ST][C][N][4][n]OFF [BINARY]; without a keyword, the file begins with the counts.
  void check_keyword() {
    std::string_view rest = text_;
    std::string_view word = take_word(rest);
    if (word.ends_with("OFF")) {
      checked_.keyword = word;
      word.remove_suffix(3);
      has_texture_ = take_prefix(word, "ST");
      has_colors_ = take_prefix(word, "C");
      has_normals_ = take_prefix(word, "N");
      if (!word.empty()) {
        lines_.refuse(
            fmt::format("'{}OFF' is not known; OFF with ST, C and N before it is", printable(word)));
      }
      if (trim(rest).starts_with("BINARY")) lines_.refuse("binary OFF is not known; write it as text");
      text_ = trim(rest);
    } else if (parse_number<std::uint64_t>(word)) {
      checked_.keyword = "OFF";
    } else {
      throw std::runtime_error(
          fmt::format("{}: is not an OFF file: it does not begin with 'OFF'", lines_.name()));
    }
    put("{}\n", checked_.keyword);
  }

  static bool take_prefix(std::string_view& word, std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  }

  void check_counts() {
    if (text_.empty() && !next_line()) end_early("its counts");
    const auto vertices = parse_number<std::uint64_t>(take_word(text_));
    const auto faces = parse_number<std::uint64_t>(take_word(text_));
    if (!vertices || !faces) lines_.refuse("the counts of vertices and faces are needed");
    vertex_count_ = *vertices;
    face_count_ = *faces;
    // A vertex takes six bytes at least, "0 0 0" and the end of its line, a face two; the last end may lack.
    const std::uint64_t bytes = lines_.rest().size() + 1;
    if (vertex_count_ > kMostHandles || vertex_count_ > bytes / 6) {
      lines_.refuse(fmt::format("{} vertices are promised, but there is no room for them", vertex_count_));
    }
    if (face_count_ > (bytes - 6 * vertex_count_) / 2) {
      lines_.refuse(fmt::format("{} faces are promised, but there is no room for them", face_count_));
    }
    put("{} {} 0\n", vertex_count_, face_count_);
  }

  // Position, normal, colour of three or four numbers, place in a texture.
  void check_vertex() {
    Vec<3> position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(text_);
      position[axis] = parse_vertex_number(word);
      if (!std::isfinite(position[axis])) {
        refuse_vertex(fmt::format("'{}' is not a finite number", printable(word)));
      }
      if (needs_float64(word, position[axis])) checked_.position_type = ScalarType::float64;
      put_float(position[axis]);
    }
    checked_.positions.push_back(position);
    for (int part = 0; has_normals_ && part < 3; ++part) put_float(parse_vertex_number(take_word(text_)));

    words_.clear();
    for (std::string_view word = take_word(text_); !word.empty(); word = take_word(text_)) {
      words_.push_back(word);
    }
    const std::size_t texture = has_texture_ ? 2 : 0;
    const std::size_t color = !has_colors_ ? 0 : words_.size() >= 4 + texture ? 4 : 3;
    if (words_.size() < color + texture) refuse_vertex("numbers are missing");
    put_color({words_.data(), color});
    for (std::size_t k = color; k < color + texture; ++k) put_float(parse_vertex_number(words_[k]));
    has_surplus_ = has_surplus_ || words_.size() > color + texture;
    end_row();
  }

  // Bytes, or floats with a point each.
  void put_color(std::span<const std::string_view> words) {
    const bool bytes = std::all_of(words.begin(), words.end(),
                                   [](std::string_view word) { return parse_number<std::uint8_t>(word); });
    for (const std::string_view word : words) {
      const double part = parse_vertex_number(word);
      if (bytes) {
        put("{} ", part);
      } else {
        put("{:#.9g} ", finite_float(part));
      }
    }
  }

  double parse_vertex_number(std::string_view word) const {
    if (word.empty()) refuse_vertex("numbers are missing");
    const std::optional<double> number = parse_double(word);
    if (!number) refuse_vertex(fmt::format("'{}' is not a number", printable(word)));
    return *number;
  }

  void check_face() {
    const std::string_view word = take_word(text_);
    const auto count = parse_number<std::uint64_t>(word);
    if (!count) refuse_face(fmt::format("'{}' is not a number of vertices", printable(word)));
    put("{} ", *count);
    for (std::uint64_t k = 0; k < *count; ++k) put("{} ", take_corner());
    end_row();
    has_face_colors_ = has_face_colors_ || !take_word(text_).empty();
  }

  std::int64_t take_corner() {
    const std::string_view word = take_word(text_);
    if (word.empty()) refuse_face("it has fewer vertices than it says");
    const auto corner = parse_number<std::int64_t>(word);
    if (!corner) refuse_face(fmt::format("'{}' is not a vertex index", printable(word)));
    if (*corner < 0 || static_cast<std::uint64_t>(*corner) >= vertex_count_) {
      refuse_face(fmt::format("it has vertex {}, but there are {} vertices", *corner, vertex_count_));
    }
    return *corner;
  }

  static float finite_float(double number) {
    const float nearest = nearest_float(number);
    return std::isfinite(nearest) ? nearest : 0.0f;
  }

  void put_float(double number) { put("{} ", finite_float(number)); }

  template <typename... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(checked_.text), format, std::forward<Arguments>(arguments)...);
  }

  // In the place of the last blank.
  void end_row() { checked_.text.back() = '\n'; }

  [[noreturn]] void refuse_vertex(const std::string& what) const {
    lines_.refuse(fmt::format("vertex {}: {}", index_, what));
  }
  [[noreturn]] void refuse_face(const std::string& what) const {
    lines_.refuse(fmt::format("face {}: {}", index_, what));
  }
  [[noreturn]] void end_early(const std::string& where) const {
    throw std::runtime_error(fmt::format("{}: the file ends at {}", lines_.name(), where));
  }

  TextLines lines_;
  std::string_view text_;  // what is left of the line
  CheckedOff checked_;
  bool has_texture_ = false;
  bool has_colors_ = false;
  bool has_normals_ = false;
  bool has_surplus_ = false;
  bool has_face_colors_ = false;
  bool has_tail_ = false;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  std::uint64_t index_ = 0;  // of the vertex or face that is read
  std::vector<std::string_view> words_;
};

}  // namespace

CheckedOff check_off(std::string_view bytes, const std::string& name) {
  return OffCheck(bytes, name).check();
}

}  // namespace solidnoise
