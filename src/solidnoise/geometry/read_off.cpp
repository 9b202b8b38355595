#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_readers.h"
#include "solidnoise/geometry/text_lines.h"
#include "solidnoise/geometry/vertex_attributes.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& name) : lines_(bytes, name) {}

  MeshReading read() {
    if (!next_line()) throw std::runtime_error(fmt::format("{}: the file holds no mesh", lines_.name()));
    read_keyword();
    read_counts();
    read_vertices();
    read_faces();
    return std::move(reading_);
  }

 private:
  // The next line that says something, without its comment.
  bool next_line() {
    while (lines_.next()) {
      const std::size_t comment = lines_.line().find('#');
      if (comment != std::string_view::npos && reading_.mesh.positions.empty()) {
        reading_.comments.emplace_back(trim(lines_.line().substr(comment + 1)));
      }
      text_ = trim(lines_.line().substr(0, comment));
      if (!text_.empty()) return true;
    }
    return false;
  }

  // [ST][C][N][4][n]OFF [BINARY]; without a keyword, the file begins with the counts.
  void read_keyword() {
    std::string_view rest = text_;
    std::string_view word = take_word(rest);
    if (!word.ends_with("OFF")) {
      if (parse_number<std::uint64_t>(word)) return;
      throw std::runtime_error(
          fmt::format("{}: is not an OFF file: it does not begin with 'OFF'", lines_.name()));
    }
    word.remove_suffix(3);
    has_texture_ = take_prefix(word, "ST");
    has_colors_ = take_prefix(word, "C");
    has_normals_ = take_prefix(word, "N");
    if (!word.empty()) {
      lines_.refuse(fmt::format("'{}OFF' is not known; OFF with ST, C and N before it is", printable(word)));
    }
    if (trim(rest).starts_with("BINARY")) lines_.refuse("binary OFF is not known; write it as text");
    text_ = trim(rest);
  }

  static bool take_prefix(std::string_view& word, std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  }

  void read_counts() {
    if (text_.empty() && !next_line()) end_early("its counts");
    const auto vertices = parse_number<std::uint64_t>(take_word(text_));
    const auto faces = parse_number<std::uint64_t>(take_word(text_));
    if (!vertices || !faces) lines_.refuse("the counts of vertices and faces are needed");
    vertex_count_ = *vertices;
    face_count_ = *faces;
    // A vertex takes six bytes at least, "0 0 0" and the end of its line, a face two; the last end may lack.
    const std::uint64_t bytes = lines_.rest().size() + 1;
    if (vertex_count_ > kMostVertices || vertex_count_ > bytes / 6) {
      lines_.refuse(fmt::format("{} vertices are promised, but there is no room for them", vertex_count_));
    }
    if (face_count_ > (bytes - 6 * vertex_count_) / 2) {
      lines_.refuse(fmt::format("{} faces are promised, but there is no room for them", face_count_));
    }
  }

  void read_vertices() {
    for (index_ = 0; index_ < vertex_count_; ++index_) {
      if (!next_line()) end_early(fmt::format("vertex {} of {}", index_, vertex_count_));
      read_vertex();
    }
    PolygonMesh& mesh = reading_.mesh;
    if (has_normals_) add_columns(normals_, kNormalNames);
    if (has_colors_) {
      // The format wants an alpha with every colour: one that is opaque everywhere says nothing.
      bool opaque = true;
      for (const TextColor& color : colors_) opaque = opaque && (std::isnan(color[3]) || color[3] == opaque_);
      add_text_colors(mesh, colors_, opaque ? 3 : 4);
    }
    if (has_texture_) add_columns(texture_, kTextureNames);
    if (has_surplus_) reading_.notes.push_back("numbers after those of the vertices are dropped");
  }

  void read_vertex() {
    Vec<3> position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(text_);
      const double number = parse_vertex_number(word);
      if (!std::isfinite(number)) refuse_vertex(fmt::format("'{}' is not a finite number", printable(word)));
      if (needs_float64(word, number)) reading_.mesh.position_type = ScalarType::float64;
      position[axis] = number;
    }
    reading_.mesh.positions.push_back(position);
    if (has_normals_) normals_.push_back(take_numbers<3>());

    // The rest of the line is the colour, of three or four numbers, and two of the texture.
    words_.clear();
    for (std::string_view word = take_word(text_); !word.empty(); word = take_word(text_)) {
      words_.push_back(parse_vertex_number(word));
    }
    const std::size_t texture = has_texture_ ? 2 : 0;
    std::size_t used = 0;
    if (has_colors_) {
      used = words_.size() >= 4 + texture ? 4 : 3;
      if (words_.size() < 3 + texture) refuse_vertex("numbers are missing");
      TextColor color{words_[0], words_[1], words_[2], std::numeric_limits<double>::quiet_NaN()};
      if (used == 4) color[3] = words_[3];
      for (const double part : color) opaque_ = part > 1.0 ? 255.0 : opaque_;
      colors_.push_back(color);
    }
    if (has_texture_) {
      if (words_.size() < used + texture) refuse_vertex("numbers are missing");
      texture_.push_back({words_[used], words_[used + 1]});
    }
    has_surplus_ = has_surplus_ || words_.size() > used + texture;
  }

  template <std::size_t Count>
  std::array<double, Count> take_numbers() {
    std::array<double, Count> numbers;
    for (double& number : numbers) number = parse_vertex_number(take_word(text_));
    return numbers;
  }

  double parse_vertex_number(std::string_view word) const {
    if (word.empty()) refuse_vertex("numbers are missing");
    const std::optional<double> number = parse_double(word);
    if (!number) refuse_vertex(fmt::format("'{}' is not a number", printable(word)));
    return *number;
  }

  template <std::size_t Count>
  void add_columns(const std::vector<std::array<double, Count>>& rows,
                   const std::array<std::string_view, Count>& names) {
    for (std::size_t c = 0; c < Count; ++c) {
      std::vector<double> values;
      values.reserve(rows.size());
      for (const auto& row : rows) values.push_back(row[c]);
      reading_.mesh.properties.push_back(text_property(names[c], std::move(values)));
    }
  }

  void read_faces() {
    bool has_colors = false;
    for (index_ = 0; index_ < face_count_; ++index_) {
      if (!next_line()) end_early(fmt::format("face {} of {}", index_, face_count_));
      const std::string_view word = take_word(text_);
      const auto count = parse_number<std::uint64_t>(word);
      if (!count) refuse_face(fmt::format("'{}' is not a number of vertices", printable(word)));
      corners_.clear();
      for (std::uint64_t k = 0; k < *count; ++k) corners_.push_back(take_corner());
      reading_.mesh.add_face(corners_);
      has_colors = has_colors || !take_word(text_).empty();
    }
    if (has_colors) reading_.notes.push_back("the colours of faces are dropped");
  }

  std::uint32_t take_corner() {
    const std::string_view word = take_word(text_);
    if (word.empty()) refuse_face("it has fewer vertices than it says");
    const auto corner = parse_number<std::int64_t>(word);
    if (!corner) refuse_face(fmt::format("'{}' is not a vertex index", printable(word)));
    if (*corner < 0 || static_cast<std::uint64_t>(*corner) >= vertex_count_) {
      refuse_face(fmt::format("it has vertex {}, but there are {} vertices", *corner, vertex_count_));
    }
    return static_cast<std::uint32_t>(*corner);
  }

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
  MeshReading reading_;
  bool has_texture_ = false;
  bool has_colors_ = false;
  bool has_normals_ = false;
  bool has_surplus_ = false;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  std::uint64_t index_ = 0;  // of the vertex or face that is read
  double opaque_ = 1.0;      // or 255
  std::vector<double> words_;
  std::vector<std::array<double, 3>> normals_;
  std::vector<TextColor> colors_;
  std::vector<std::array<double, 2>> texture_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

MeshReading read_off(std::string_view bytes, const std::string& name) {
  return OffReader(bytes, name).read();
}

}  // namespace solidnoise
