#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/geometry/byte_reader.h"
#include "solidnoise/geometry/mesh_readers.h"
#include "solidnoise/geometry/om_format.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

constexpr std::size_t kHeaderBytes = 16;

// What version 2 calls the types of its custom properties.
constexpr std::array<std::pair<std::string_view, ScalarType>, 12> kCustomTypes{{
    {"char", ScalarType::int8},
    {"signed char", ScalarType::int8},
    {"unsigned char", ScalarType::uint8},
    {"int8_t", ScalarType::int8},
    {"uint8_t", ScalarType::uint8},
    {"int16_t", ScalarType::int16},
    {"uint16_t", ScalarType::uint16},
    {"int32_t", ScalarType::int32},
    {"int", ScalarType::int32},
    {"uint32_t", ScalarType::uint32},
    {"float", ScalarType::float32},
    {"double", ScalarType::float64},
}};

class OmReader {
 public:
  OmReader(std::string_view bytes, const std::string& name)
      : reader_(bytes, std::endian::little), name_(name) {}

  MeshReading read() {
    read_header();
    while (reader_.left() >= sizeof(std::uint16_t)) {
      const OmChunk chunk = OmChunk::unpack(reader_.take<std::uint16_t>());
      if (chunk.entity == OmChunk::end) break;
      read_chunk(chunk);
    }
    if (reading_.mesh.positions.size() != vertex_count_) refuse("the vertices have no positions");
    if (version_ >= om_version(2, 0)) walk_faces();
    if (reading_.mesh.face_count() != face_count_) refuse("the faces have no vertices");
    return std::move(reading_);
  }

 private:
  struct Halfedge {
    std::int64_t next;
    std::int64_t vertex;  // that it points to
  };

  void read_header() {
    if (reader_.left() < kHeaderBytes || reader_.take_bytes(2) != "OM") {
      refuse("is not an OM file: it does not begin with 'OM'");
    }
    kind_ = reader_.take<char>();
    if (std::string_view("TQP").find(kind_) == std::string_view::npos) refuse("the kind of faces is unknown");
    version_ = reader_.take<std::uint8_t>();
    if (version_ >> 5 < 1 || version_ >> 5 > 2) {
      refuse(fmt::format("version {}.{} is unknown", version_ >> 5, version_ & 31));
    }
    vertex_count_ = reader_.take<std::uint32_t>();
    face_count_ = reader_.take<std::uint32_t>();
    edge_count_ = reader_.take<std::uint32_t>();
  }

  void read_chunk(const OmChunk& chunk) {
    const std::string name = chunk.named ? read_string() : std::string();
    if (chunk.type == OmChunk::custom) {
      read_custom(chunk, name);
    } else if (chunk.type == OmChunk::topology) {
      read_topology(chunk);
    } else if (chunk.entity != OmChunk::vertex) {
      skip(chunk);
    } else if (chunk.type == OmChunk::position) {
      read_positions(chunk);
    } else if (chunk.type == OmChunk::normal && chunk.dimensions == 3) {
      read_columns(chunk, kNormalNames);
    } else if (chunk.type == OmChunk::color && (chunk.dimensions == 3 || chunk.dimensions == 4)) {
      read_columns(chunk, std::span(kColorNames).first(chunk.dimensions));
    } else {
      skip(chunk);
    }
  }

  std::uint64_t count(const OmChunk& chunk) const {
    switch (chunk.entity) {
      case OmChunk::vertex:
        return vertex_count_;
      case OmChunk::mesh:
        return 1;
      case OmChunk::face:
        return face_count_;
      case OmChunk::edge:
        return edge_count_;
      case OmChunk::halfedge:
        return 2 * std::uint64_t{edge_count_};
      default:
        refuse(fmt::format("unknown kind of element {}", chunk.entity));
    }
  }

  // Asks that there be `size` bytes for every element of the chunk's kind.
  void require_bytes(const OmChunk& chunk, std::uint64_t size) const {
    if (count(chunk) <= reader_.left() / size) return;
    constexpr std::array<std::string_view, 8> kEntities{"vertex", "mesh", "face",      "",
                                                        "edge",   "",     "half-edge", ""};
    refuse(fmt::format("the file ends at {} {} of {}", kEntities[chunk.entity], reader_.left() / size,
                       count(chunk)));
  }

  ScalarType float_type(const OmChunk& chunk) const {
    if (!chunk.is_float || chunk.bits > 1) refuse("a number has an unknown type");
    return chunk.bits == 0 ? ScalarType::float32 : ScalarType::float64;
  }

  // Topology has bytes by `bits` although it is marked as float; a status has 32 bits although it is marked
  // as 8.
  std::uint64_t integer_size(const OmChunk& chunk) const {
    return chunk.type == OmChunk::status ? sizeof(std::uint32_t) : std::uint64_t{1} << chunk.bits;
  }

  void skip(const OmChunk& chunk) {
    const bool floats = chunk.type <= OmChunk::texture;
    const std::uint64_t size = chunk.dimensions * (floats ? size_of(float_type(chunk)) : integer_size(chunk));
    require_bytes(chunk, size);
    reader_.take_bytes(static_cast<std::size_t>(count(chunk) * size));
    if (chunk.entity == OmChunk::vertex && chunk.type == OmChunk::texture) {
      note("texture coordinates are dropped");
    } else if (chunk.entity == OmChunk::face && chunk.type == OmChunk::color) {
      note("the colours of faces are dropped");
    }
  }

  void read_positions(const OmChunk& chunk) {
    const ScalarType type = float_type(chunk);
    if (chunk.dimensions != 3) refuse(fmt::format("positions have {} dimensions", chunk.dimensions));
    require_bytes(chunk, 3 * size_of(type));
    auto& positions = reading_.mesh.positions;
    positions.resize(vertex_count_);
    reading_.mesh.position_type = type;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      for (int axis = 0; axis < 3; ++axis) {
        positions[v][axis] = take(type);
        if (!std::isfinite(positions[v][axis])) {
          refuse(fmt::format("vertex {}: its {} is not finite", v, "xyz"[axis]));
        }
      }
    }
  }

  void read_columns(const OmChunk& chunk, std::span<const std::string_view> names) {
    if (!chunk.is_float && chunk.bits != 0) refuse("colours have an unknown type");
    const ScalarType type = chunk.is_float ? float_type(chunk) : ScalarType::uint8;
    require_bytes(chunk, names.size() * size_of(type));
    std::vector<VertexProperty> columns;
    for (const std::string_view name : names) {
      columns.push_back({std::string(name), type, std::vector<double>(vertex_count_)});
    }
    for (std::size_t v = 0; v < vertex_count_; ++v) {
      for (VertexProperty& column : columns) column.values[v] = take(type);
    }
    for (VertexProperty& column : columns) reading_.mesh.set_property(std::move(column));
  }

  // Version 2 keeps the type's name. Where it is a number per vertex, it is kept.
  void read_custom(const OmChunk& chunk, const std::string& name) {
    const std::string type_name = version_ >= om_version(2, 2) ? read_string() : std::string();
    std::uint32_t size = sizeof size;
    const auto require = [&] {
      if (size > reader_.left()) refuse(fmt::format("the file ends in property '{}'", printable(name)));
    };
    require();
    size = reader_.take<std::uint32_t>();
    require();
    const auto* const known = std::find_if(kCustomTypes.begin(), kCustomTypes.end(), [&](const auto& entry) {
      return chunk.entity == OmChunk::vertex && entry.first == type_name;
    });
    const bool has_blanks = name.empty() || name.find_first_of(" \t\r\n\v\f") != std::string::npos;
    if (known == kCustomTypes.end() || has_blanks || size != size_of(known->second) * vertex_count_) {
      reader_.take_bytes(size);
      note(fmt::format("property '{}' is dropped", printable(name)));
      return;
    }
    VertexProperty property{name, known->second, std::vector<double>(vertex_count_)};
    for (double& value : property.values) value = take(known->second);
    reading_.mesh.set_property(std::move(property));
  }

  void read_topology(const OmChunk& chunk) {
    if (chunk.entity == OmChunk::face && version_ < om_version(2, 0)) {
      read_corner_lists(chunk);
    } else if (chunk.entity == OmChunk::halfedge) {
      const std::uint64_t size = integer_size(chunk);
      require_bytes(chunk, 3 * size);
      halfedges_.resize(static_cast<std::size_t>(count(chunk)));
      for (Halfedge& halfedge : halfedges_) {
        halfedge.next = take_signed(size);
        halfedge.vertex = take_signed(size);
        take_signed(size);  // the face
      }
    } else if (chunk.entity == OmChunk::face) {
      const std::uint64_t size = integer_size(chunk);
      require_bytes(chunk, size);
      face_halfedges_.resize(face_count_);
      for (std::int64_t& halfedge : face_halfedges_) halfedge = take_signed(size);
    } else {
      const std::uint64_t size = integer_size(chunk) * chunk.dimensions;
      require_bytes(chunk, size);
      reader_.take_bytes(static_cast<std::size_t>(count(chunk) * size));
    }
  }

  // Version 1: the vertices of each face, preceded by their number where faces differ in it.
  void read_corner_lists(const OmChunk& chunk) {
    const std::uint64_t size = integer_size(chunk);
    std::vector<std::uint32_t> corners;
    for (std::uint32_t f = 0; f < face_count_; ++f) {
      const auto require = [&](std::uint64_t bytes) {
        if (reader_.left() < bytes) refuse(fmt::format("the file ends at face {} of {}", f, face_count_));
      };
      std::uint64_t corner_count = kind_ == 'T' ? 3 : 4;
      if (kind_ == 'P') {
        require(sizeof(std::uint16_t));
        corner_count = reader_.take<std::uint16_t>();
      }
      require(corner_count * size);
      corners.clear();
      for (; corner_count > 0; --corner_count) corners.push_back(checked_corner(f, take_unsigned(size)));
      reading_.mesh.add_face(corners);
    }
  }

  // Version 2: from each face's half-edge along the next ones until it is met again.
  void walk_faces() {
    std::vector<bool> used(halfedges_.size());
    std::vector<std::uint32_t> corners;
    for (std::size_t f = 0; f < face_halfedges_.size(); ++f) {
      corners.clear();
      std::int64_t current = face_halfedges_[f];
      do {
        const auto index = static_cast<std::size_t>(current);
        if (current < 0 || index >= halfedges_.size()) {
          refuse(
              fmt::format("face {}: it has half-edge {}, but there are {}", f, current, halfedges_.size()));
        }
        if (used[index]) refuse(fmt::format("face {}: its half-edges are no loop of its own", f));
        used[index] = true;
        corners.push_back(checked_corner(f, static_cast<std::uint64_t>(halfedges_[index].vertex)));
        current = halfedges_[index].next;
      } while (current != face_halfedges_[f]);
      reading_.mesh.add_face(corners);
    }
  }

  std::uint32_t checked_corner(std::size_t face, std::uint64_t corner) const {
    if (corner >= vertex_count_) {
      refuse(fmt::format("face {}: it has vertex {}, but there are {} vertices", face,
                         static_cast<std::int64_t>(corner), vertex_count_));
    }
    return static_cast<std::uint32_t>(corner);
  }

  std::string read_string() {
    if (reader_.left() < 1) refuse("the file ends in a name");
    const std::size_t size = reader_.take<std::uint8_t>();
    if (reader_.left() < size) refuse("the file ends in a name");
    return std::string(reader_.take_bytes(size));
  }

  double take(ScalarType type) {
    return visit_scalar_type(
        type, [this](auto number) { return static_cast<double>(reader_.take<decltype(number)>()); });
  }

  std::int64_t take_signed(std::uint64_t size) {
    switch (size) {
      case 1:
        return reader_.take<std::int8_t>();
      case 2:
        return reader_.take<std::int16_t>();
      case 4:
        return reader_.take<std::int32_t>();
      default:
        return reader_.take<std::int64_t>();
    }
  }

  std::uint64_t take_unsigned(std::uint64_t size) {
    switch (size) {
      case 1:
        return reader_.take<std::uint8_t>();
      case 2:
        return reader_.take<std::uint16_t>();
      case 4:
        return reader_.take<std::uint32_t>();
      default:
        return reader_.take<std::uint64_t>();
    }
  }

  void note(std::string text) { reading_.notes.push_back(std::move(text)); }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", name_, what));
  }

  ByteReader reader_;
  const std::string& name_;
  char kind_ = 'P';
  std::uint8_t version_ = 0;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
  std::uint32_t edge_count_ = 0;
  MeshReading reading_;
  std::vector<Halfedge> halfedges_;
  std::vector<std::int64_t> face_halfedges_;
};

}  // namespace

MeshReading read_om(std::string_view bytes, const std::string& name) {
  return OmReader(bytes, name).read();
}

}  // namespace solidnoise
