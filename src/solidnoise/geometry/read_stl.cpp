#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/geometry/byte_reader.h"
#include "solidnoise/geometry/mesh_readers.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;  // a normal and three corners of three floats each, and 16 bits
constexpr std::size_t kFirstFacet = kHeaderBytes + sizeof(std::uint32_t);

struct PositionHash {
  std::size_t operator()(const Vec<3>& p) const {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash ^= std::bit_cast<std::uint64_t>(p[axis]);
      hash *= 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio: spreads the high bits, which floats use
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

// Gives every position one vertex, in order of first use.
class VertexMerger {
 public:
  explicit VertexMerger(PolygonMesh& mesh) : mesh_(mesh) {}

  std::uint32_t vertex_at(Vec<3> position) {
    position += 0.0;  // makes -0 the same as 0
    const auto [found, is_new] =
        vertices_.try_emplace(position, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(position);
    return found->second;
  }

 private:
  PolygonMesh& mesh_;
  std::unordered_map<Vec<3>, std::uint32_t, PositionHash> vertices_;
};

std::uint64_t promised_facets(std::string_view bytes) {
  return ByteReader(bytes.substr(kHeaderBytes), std::endian::little).take<std::uint32_t>();
}

// Programs write binary files that begin with `solid`, too. What tells them apart is the length that the
// count of facets implies, and then, whether there is a facet in words.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= kFirstFacet && bytes.size() == kFirstFacet + kFacetBytes * promised_facets(bytes)) {
    return true;
  }
  std::string_view text = bytes;
  while (!text.empty() && (text.front() == '\n' || trim(text.substr(0, 1)).empty())) text.remove_prefix(1);
  if (!text.starts_with("solid")) return true;
  constexpr std::size_t kLongestName = 4096;
  const std::string_view head = text.substr(0, kLongestName);
  return head.find("facet") == std::string_view::npos && head.find("endsolid") == std::string_view::npos;
}

MeshReading read_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kFirstFacet) {
    throw std::runtime_error(fmt::format("{}: is not an STL file, or ends within its header", name));
  }
  const std::uint64_t count = promised_facets(bytes);
  const std::uint64_t room = (bytes.size() - kFirstFacet) / kFacetBytes;
  if (count > room) {
    throw std::runtime_error(
        fmt::format("{}: the header promises {} facets, but there is room for {}", name, count, room));
  }
  MeshReading reading;
  VertexMerger merger(reading.mesh);
  ByteReader reader(bytes.substr(kFirstFacet), std::endian::little);
  bool has_attributes = false;
  for (std::uint64_t facet = 0; facet < count; ++facet) {
    reader.take_bytes(3 * sizeof(float));  // the normal
    std::array<std::uint32_t, 3> corners;
    for (std::uint32_t& corner : corners) {
      Vec<3> position;
      for (int axis = 0; axis < 3; ++axis) position[axis] = static_cast<double>(reader.take<float>());
      if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
        throw std::runtime_error(
            fmt::format("{}: face {}: a vertex has a position that is not finite", name, facet));
      }
      corner = merger.vertex_at(position);
    }
    has_attributes = reader.take<std::uint16_t>() != 0 || has_attributes;
    reading.mesh.add_face(corners);
  }
  if (has_attributes) reading.notes.push_back("the attributes (colours) of facets are dropped");
  if (reader.left() > 0) {
    reading.notes.push_back(fmt::format("{} bytes after the last facet are ignored", reader.left()));
  }
  return reading;
}

// solid NAME { facet normal x y z, outer loop, { vertex x y z }, endloop, endfacet } endsolid NAME, any
// number of them.
class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& name) : lines_(bytes, name), merger_(reading_.mesh) {}

  MeshReading read() {
    while (lines_.next()) {
      std::string_view text = lines_.line();
      const std::string_view keyword = take_word(text);
      if (keyword == "vertex") {
        read_vertex(text);
      } else if (keyword == "endloop") {
        end_loop();
      } else if (keyword == "endsolid") {
        in_solid_ = false;
      } else if (keyword == "solid") {
        in_solid_ = true;
      } else if (keyword == "outer" || keyword == "facet" || keyword == "endfacet" || keyword.empty()) {
        continue;
      } else {
        lines_.refuse(fmt::format("'{}' has no place in an STL file", printable(keyword)));
      }
    }
    if (in_solid_ || !corners_.empty()) {
      throw std::runtime_error(
          fmt::format("{}: the file ends at face {}, before 'endsolid'", lines_.name(), face()));
    }
    return std::move(reading_);
  }

 private:
  std::size_t face() const { return reading_.mesh.face_count(); }

  void read_vertex(std::string_view text) {
    Vec<3> position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(text);
      const std::optional<double> number = parse_double(word);
      if (!number || !std::isfinite(*number)) {
        refuse(word.empty() ? std::string("a vertex needs three coordinates")
                            : fmt::format("'{}' is not a finite number", printable(word)));
      }
      if (needs_float64(word, *number)) reading_.mesh.position_type = ScalarType::float64;
      position[axis] = *number;
    }
    corners_.push_back(merger_.vertex_at(position));
  }

  void end_loop() {
    if (corners_.empty()) refuse("it has no vertices");
    reading_.mesh.add_face(corners_);
    corners_.clear();
  }

  [[noreturn]] void refuse(const std::string& what) const {
    lines_.refuse(fmt::format("face {}: {}", face(), what));
  }

  TextLines lines_;
  MeshReading reading_;
  VertexMerger merger_;
  std::vector<std::uint32_t> corners_;  // of this facet
  bool in_solid_ = false;
};

}  // namespace

MeshReading read_stl(std::string_view bytes, const std::string& name) {
  return is_binary(bytes) ? read_binary(bytes, name) : TextReader(bytes, name).read();
}

}  // namespace solidnoise
