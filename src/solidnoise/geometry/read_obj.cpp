#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

// By ourselves: OpenMesh's reader stops without a word at what is no number, drops faces of vertices that are
// not there, has floats only, and gives no comments, which hold recipes; its writer refuses colours.
class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : lines_(bytes, name) {}

  MeshReading read() {
    while (next_statement()) {
      std::string_view text = statement_;
      const std::string_view keyword = take_word(text);
      if (keyword == "v") {
        read_vertex(text);
      } else if (keyword == "f") {
        read_face(text);
      } else if (keyword == "vn") {
        read_normal(text);
      } else if (keyword == "vt") {
        read_texture(text);
      } else if (keyword == "l" || keyword == "p") {
        ++lines_and_points_;
      } else if (is_any_of(keyword, {"g", "o", "s", "usemtl", "mtllib"})) {
        has_parts_ = true;
      }
    }
    add_colors();
    add_normals();
    add_texture();
    if (!texture_.empty()) note("texture coordinates are dropped");
    if (lines_and_points_ > 0) note(fmt::format("{} lines or points are dropped", lines_and_points_));
    if (has_parts_) note("groups and materials are dropped");
    return std::move(reading_);
  }

 private:
  // A line without its comment, together with those that it continues by a backslash at the end.
  bool next_statement() {
    if (!lines_.next()) return false;
    statement_ = lines_.line();
    if (continues_obj_line(statement_)) join_lines();
    const std::size_t comment = statement_.find('#');
    if (comment == std::string_view::npos) return true;
    if (reading_.mesh.positions.empty()) {
      reading_.comments.emplace_back(trim(statement_.substr(comment + 1)));
    }
    statement_ = statement_.substr(0, comment);
    return true;
  }

  void join_lines() {
    joined_.clear();
    std::string_view part = statement_;
    while (continues_obj_line(part)) {
      part.remove_suffix(1);
      joined_ += part;
      joined_ += ' ';
      part = lines_.next() ? lines_.line() : std::string_view();
    }
    joined_ += part;
    statement_ = joined_;
  }

  // x y z, x y z w, x y z r g b, x y z r g b a
  void read_vertex(std::string_view text) {
    std::array<double, 7> numbers{};
    std::size_t count = 0;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      if (count == numbers.size()) refuse_vertex("it has more than seven numbers");
      const std::optional<double> number = parse_double(word);
      if (!number || !std::isfinite(*number)) {
        refuse_vertex(fmt::format("'{}' is not a finite number", printable(word)));
      }
      if (count < 3 && needs_float64(word, *number)) reading_.mesh.position_type = ScalarType::float64;
      numbers[count++] = *number;
    }
    if (count < 3) refuse_vertex("it needs three coordinates");
    auto& positions = reading_.mesh.positions;
    if (positions.size() >= std::numeric_limits<std::uint32_t>::max()) {
      lines_.refuse("more than 2^32 vertices");
    }
    positions.emplace_back(numbers[0], numbers[1], numbers[2]);
    if (count >= 6) {
      has_alpha_ = has_alpha_ || count == 7;
      colored_ += 1;
      colors_.resize(positions.size(), kNoColor);
      colors_.back() = {numbers[3], numbers[4], numbers[5], count == 7 ? numbers[6] : kNoNumber};
    }
  }

  void add_colors() {
    if (colored_ == 0) return;
    const std::size_t count = reading_.mesh.positions.size();
    if (colored_ < count) note(fmt::format("{} vertices without a colour are white", count - colored_));
    colors_.resize(count, kNoColor);
    add_text_colors(reading_.mesh, colors_, has_alpha_ ? 4 : 3);
  }

  void read_normal(std::string_view text) {
    Vec<3> normal;
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> number = parse_double(take_word(text));
      if (!number) lines_.refuse("a normal needs three numbers");
      normal[axis] = *number;
    }
    normals_.push_back(normal);
  }

  // Normals belong to the vertices if every corner has that of its vertex's number.
  void add_normals() {
    if (normals_.empty()) return;
    const std::size_t count = reading_.mesh.positions.size();
    if (!normals_of_vertices_ || normals_.size() != count) {
      note("normals of the faces' corners are dropped");
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      values.reserve(count);
      for (const Vec<3>& normal : normals_) values.push_back(normal[axis]);
      reading_.mesh.properties.push_back(
          text_property(kNormalNames[static_cast<std::size_t>(axis)], std::move(values)));
    }
  }

  // What is no number is none; whoever needs it says so.
  void read_texture(std::string_view text) {
    const double u = parse_double(take_word(text)).value_or(kNoNumber);
    const double v = parse_double(take_word(text)).value_or(kNoNumber);
    texture_.emplace_back(u, v);
  }

  void add_texture() {
    const auto missing = [](const Vec<2>& place) { return std::isnan(place.x); };
    if (!std::all_of(reading_.texture.begin(), reading_.texture.end(), missing)) return;
    reading_.texture.clear();
  }

  Vec<2> texture_at(std::string_view word) const {
    const std::optional<std::int64_t> number = parse_number<std::int64_t>(word);
    const auto count = static_cast<std::int64_t>(texture_.size());
    const bool in_range = number && (*number > 0 ? *number <= count : *number < 0 && *number >= -count);
    if (!in_range) return Vec<2>(kNoNumber);
    return texture_[static_cast<std::size_t>(*number > 0 ? *number - 1 : count + *number)];
  }

  // Corners are v, v/t, v//n or v/t/n.
  void read_face(std::string_view text) {
    corners_.clear();
    corner_texture_.clear();
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      const std::size_t first = word.find('/');
      corners_.push_back(vertex_index(word.substr(0, first)));
      const std::size_t second = first == std::string_view::npos ? first : word.find('/', first + 1);
      if (!texture_.empty()) {
        reading_.texture.resize(reading_.mesh.corners.size(), Vec<2>(kNoNumber));  // of faces before any vt
        corner_texture_.push_back(first == std::string_view::npos
                                      ? Vec<2>(kNoNumber)
                                      : texture_at(word.substr(first + 1, second - first - 1)));
      }
      const bool same = second != std::string_view::npos && is_own_normal(word.substr(second + 1));
      normals_of_vertices_ = normals_of_vertices_ && same;
    }
    if (corners_.empty()) refuse_face("it has no vertices");
    reading_.mesh.add_face(corners_);
    reading_.texture.insert(reading_.texture.end(), corner_texture_.begin(), corner_texture_.end());
  }

  // Indices count from 1, or, if negative, back from the last vertex so far.
  std::uint32_t vertex_index(std::string_view word) const {
    const std::optional<std::int64_t> number = parse_number<std::int64_t>(word);
    if (!number) refuse_face(fmt::format("'{}' is not a vertex index", printable(word)));
    const auto count = static_cast<std::int64_t>(reading_.mesh.positions.size());
    const bool in_range = *number > 0 ? *number <= count : *number < 0 && *number >= -count;
    if (!in_range) {
      refuse_face(fmt::format("vertex index {} is out of range, {} vertices so far", *number, count));
    }
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
  }

  // Whether a corner's normal is the one of its vertex's number.
  bool is_own_normal(std::string_view word) const {
    const std::optional<std::int64_t> number = parse_number<std::int64_t>(word);
    if (!number) return false;
    const auto count = static_cast<std::int64_t>(normals_.size());
    return (*number > 0 ? *number - 1 : count + *number) == static_cast<std::int64_t>(corners_.back());
  }

  [[noreturn]] void refuse_vertex(const std::string& what) const {
    lines_.refuse(fmt::format("vertex {}: {}", reading_.mesh.positions.size() + 1, what));
  }
  [[noreturn]] void refuse_face(const std::string& what) const {
    lines_.refuse(fmt::format("face {}: {}", reading_.mesh.face_count() + 1, what));
  }

  static bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  }

  void note(std::string text) { reading_.notes.push_back(std::move(text)); }

  TextLines lines_;
  std::string_view statement_;
  std::string joined_;
  MeshReading reading_;
  std::vector<std::uint32_t> corners_;  // of a face
  std::vector<TextColor> colors_;
  std::size_t colored_ = 0;
  std::size_t lines_and_points_ = 0;
  bool has_alpha_ = false;
  std::vector<Vec<3>> normals_;
  bool normals_of_vertices_ = true;
  std::vector<Vec<2>> texture_;
  std::vector<Vec<2>> corner_texture_;  // of a face
  bool has_parts_ = false;
};

}  // namespace

MeshReading read_obj(std::string_view bytes, const std::string& name) {
  return ObjReader(bytes, name).read();
}

}  // namespace solidnoise
