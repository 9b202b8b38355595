#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <istream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "solidnoise/volume/triangle_mesh.h"

namespace solidnoise {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

// Takes the next word off the front of `text`; empty if there is none.
std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlank));
  text.remove_prefix(word.size());
  return word;
}

template <typename Number>
std::optional<Number> parse(std::string_view word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

class ObjReader {
 public:
  ObjReader(std::istream& stream, const std::string& name) : stream_(stream), name_(name) {}

  TriangleMesh read() {
    std::string line;
    while (next_line(line)) {
      std::string_view text = std::string_view(line).substr(0, line.find('#'));
      const std::string_view keyword = take_word(text);
      if (keyword == "v") read_vertex(text);
      if (keyword == "f") read_face(text);
    }
    if (stream_.bad()) throw std::runtime_error(fmt::format("{}: reading failed", name_));
    return std::move(mesh_);
  }

 private:
  // A line, with those that it continues by a backslash at the end.
  bool next_line(std::string& line) {
    line.clear();
    std::string part;
    while (std::getline(stream_, part)) {
      ++line_number_;
      if (!part.empty() && part.back() == '\r') part.pop_back();
      const bool continued = !part.empty() && part.back() == '\\';
      if (continued) part.back() = ' ';
      line += part;
      if (!continued) return true;
    }
    return !line.empty();
  }

  void read_vertex(std::string_view text) {
    Vec<3> position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(text);
      const std::optional<double> number = parse<double>(word);
      if (!number || !std::isfinite(*number)) {
        refuse(word.empty() ? std::string("a vertex needs three coordinates")
                            : fmt::format("'{}' is not a finite number", word));
      }
      position[axis] = *number;
    }
    if (mesh_.positions.size() >= std::numeric_limits<std::uint32_t>::max())
      refuse("more than 2^32 vertices");
    mesh_.positions.push_back(position);
  }

  void read_face(std::string_view text) {
    corners_.clear();
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      corners_.push_back(corner(word.substr(0, word.find('/'))));
    }
    if (corners_.size() < 3)
      refuse(fmt::format("a face needs three vertices, this one has {}", corners_.size()));
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      mesh_.triangles.push_back({corners_[0], corners_[i - 1], corners_[i]});
    }
  }

  // Indices count from 1, or, if negative, back from the last vertex so far.
  std::uint32_t corner(std::string_view word) const {
    const std::optional<std::int64_t> number = parse<std::int64_t>(word);
    if (!number) refuse(fmt::format("'{}' is not a vertex index", word));
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    const bool in_range = *number > 0 ? *number <= count : *number < 0 && *number >= -count;
    if (!in_range) refuse(fmt::format("vertex index {} is out of range, {} vertices so far", *number, count));
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line_number_, what));
  }

  std::istream& stream_;
  const std::string& name_;
  std::size_t line_number_ = 0;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

TriangleMesh read_obj(std::istream& stream, const std::string& name) {
  return ObjReader(stream, name).read();
}

TriangleMesh read_obj(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(fmt::format("{}: is a folder, not a mesh", path.string()));
  }
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".obj") {
    throw std::runtime_error(fmt::format("{}: only Wavefront meshes (.obj) can be read", path.string()));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read: {}", path.string(), std::generic_category().message(errno)));
  }
  return read_obj(stream, path.string());
}

}  // namespace solidnoise
