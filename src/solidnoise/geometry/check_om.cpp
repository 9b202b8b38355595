#include "solidnoise/geometry/check_om.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

using namespace OpenMesh::IO::OMFormat;

constexpr std::size_t kOmHeaderBytes = 16;
constexpr std::uint64_t kMostElements = std::numeric_limits<std::int32_t>::max();  // of OpenMesh's

// What the format calls the types of numbers; those of OpenMesh can make a property of.
constexpr std::array<std::pair<std::string_view, ScalarType>, 8> kCustomTypes{{
    {"int8_t", ScalarType::int8},
    {"uint8_t", ScalarType::uint8},
    {"int16_t", ScalarType::int16},
    {"uint16_t", ScalarType::uint16},
    {"int32_t", ScalarType::int32},
    {"uint32_t", ScalarType::uint32},
    {"float", ScalarType::float32},
    {"double", ScalarType::float64},
}};

class OmCheck {
 public:
  OmCheck(std::string_view bytes, const std::string& name)
      : bytes_(bytes), reader_(bytes, std::endian::little), name_(name) {}

  CheckedOm check() {
    check_header();
    checked_.bytes = bytes_.substr(0, kOmHeaderBytes);
    while (reader_.left() >= chunk_header_size()) {
      begin_ = bytes_.size() - reader_.left();
      Chunk::Header chunk{};
      chunk << reader_.take<std::uint16_t>();
      if (chunk.entity_ == Chunk::Entity_Sentinel) break;
      check_chunk(chunk);
    }
    const bool has_loops = version() >= mk_version(2, 0);
    if (!takes(Chunk::Entity_Vertex, Chunk::Type_Pos) && vertices() > 0) {
      refuse("the vertices have no positions");
    }
    const bool has_faces = takes(Chunk::Entity_Face, Chunk::Type_Topology) &&
                           (!has_loops || takes(Chunk::Entity_Halfedge, Chunk::Type_Topology));
    if (!has_faces && faces() > 0) refuse("the faces have no vertices");
    return std::move(checked_);
  }

 private:
  std::uint8_t version() const { return checked_.header.version_; }
  std::uint32_t vertices() const { return checked_.header.n_vertices_; }
  std::uint32_t faces() const { return checked_.header.n_faces_; }

  void check_header() {
    if (reader_.left() < kOmHeaderBytes || reader_.take_bytes(2) != "OM") {
      refuse("is not an OM file: it does not begin with 'OM'");
    }
    Header& header = checked_.header;
    header.mesh_ = reader_.take<unsigned char>();
    if (std::string_view("TQP").find(static_cast<char>(header.mesh_)) == std::string_view::npos) {
      refuse("the kind of faces is unknown");
    }
    header.version_ = reader_.take<std::uint8_t>();
    if (header.version_ < mk_version(1, 0) || header.version_ > mk_version(2, 2)) {
      refuse(fmt::format("version {}.{} is unknown", header.version_ >> 5, header.version_ & 31));
    }
    header.n_vertices_ = reader_.take<std::uint32_t>();
    header.n_faces_ = reader_.take<std::uint32_t>();
    header.n_edges_ = reader_.take<std::uint32_t>();
  }

  void check_chunk(const Chunk::Header& chunk) {
    const std::string name = chunk.name_ ? read_string() : std::string();
    const bool of_vertices = chunk.entity_ == Chunk::Entity_Vertex;
    if (chunk.type_ == Chunk::Type_Custom) {
      check_custom(chunk, name);
    } else if (chunk.type_ == Chunk::Type_Topology) {
      check_topology(chunk);
    } else if (of_vertices && chunk.type_ == Chunk::Type_Pos) {
      if (dimensions(chunk) != 3) refuse(fmt::format("positions have {} dimensions", dimensions(chunk)));
      take(chunk, 3 * float_size(chunk));
    } else if (of_vertices && chunk.type_ == Chunk::Type_Normal && dimensions(chunk) == 3) {
      take(chunk, 3 * float_size(chunk));
    } else if (of_vertices && chunk.type_ == Chunk::Type_Color && dimensions(chunk) == 3 && !chunk.float_ &&
               chunk.bits_ == Chunk::Integer_8) {
      take(chunk, 3);
    } else {
      skip(chunk);
    }
  }

  // Version 2 keeps the type's name. Where it is a number per vertex, it is kept.
  void check_custom(const Chunk::Header& chunk, const std::string& name) {
    const std::string type_name = version() >= mk_version(2, 2) ? read_string() : std::string();
    const auto require = [&](std::uint64_t bytes) {
      if (bytes > reader_.left()) refuse(fmt::format("the file ends in property '{}'", printable(name)));
    };
    require(sizeof(std::uint32_t));
    const auto size = reader_.take<std::uint32_t>();
    require(size);
    reader_.take_bytes(size);
    const auto* const known = std::find_if(kCustomTypes.begin(), kCustomTypes.end(),
                                           [&](const auto& entry) { return entry.first == type_name; });
    if (chunk.entity_ == Chunk::Entity_Vertex && known != kCustomTypes.end() && can_be_named(name) &&
        size == size_of(known->second) * vertices() && !is_kept(name)) {
      checked_.properties.emplace_back(name, known->second);
      copy_chunk();
    } else {
      note(fmt::format("property '{}' is dropped", printable(name)));
    }
  }

  // Words that are no coordinate's name. OpenMesh ends names at a zero.
  static bool can_be_named(const std::string& name) {
    return !name.empty() && name != "x" && name != "y" && name != "z" &&
           std::none_of(name.begin(), name.end(),
                        [](char c) { return static_cast<unsigned char>(c) <= ' '; });
  }

  bool is_kept(const std::string& name) const {
    return std::any_of(checked_.properties.begin(), checked_.properties.end(),
                       [&](const auto& property) { return property.first == name; });
  }

  // Of faces: lists of vertices, or a half-edge of each. Of half-edges: the next one, vertex and face.
  void check_topology(const Chunk::Header& chunk) {
    const bool lists = version() < mk_version(2, 0);
    if (chunk.entity_ == Chunk::Entity_Face && lists) {
      check_corner_lists(chunk);
    } else if (chunk.entity_ == Chunk::Entity_Face) {
      take(chunk, integer_size(chunk));
    } else if (chunk.entity_ == Chunk::Entity_Halfedge && !lists) {
      take(chunk, 3 * integer_size(chunk));
    } else {
      skip_elements(chunk, dimensions(chunk) * integer_size(chunk));
    }
  }

  // Version 1: the vertices of each face, preceded by their number where faces differ in it.
  void check_corner_lists(const Chunk::Header& chunk) {
    const std::uint64_t size = integer_size(chunk);
    for (std::uint32_t f = 0; f < faces(); ++f) {
      const auto require = [&](std::uint64_t bytes) {
        if (reader_.left() < bytes) refuse(fmt::format("the file ends at face {} of {}", f, faces()));
      };
      std::uint64_t corners = checked_.header.mesh_ == 'T' ? 3 : 4;
      if (checked_.header.mesh_ == 'P') {
        require(sizeof(std::uint16_t));
        corners = reader_.take<std::uint16_t>();
      }
      require(corners * size);
      reader_.take_bytes(static_cast<std::size_t>(corners * size));
    }
    keep(chunk);
  }

  // Takes a chunk of `size` bytes per element; the first of its kind is kept.
  void take(const Chunk::Header& chunk, std::uint64_t size) {
    skip_elements(chunk, size);
    keep(chunk);
  }

  void keep(const Chunk::Header& chunk) {
    const auto kind = std::pair(chunk.entity_, chunk.type_);
    // OpenMesh takes a chunk of half-edges without any for the file's end.
    if (takes(kind.first, kind.second) || count(chunk) == 0) return;
    taken_.push_back(kind);
    copy_chunk();
  }

  bool takes(unsigned entity, unsigned type) const {
    return std::find(taken_.begin(), taken_.end(), std::pair(entity, type)) != taken_.end();
  }

  void copy_chunk() { checked_.bytes += bytes_.substr(begin_, bytes_.size() - reader_.left() - begin_); }

  void skip(const Chunk::Header& chunk) {
    const bool floats = chunk.type_ <= Chunk::Type_Texcoord;
    // A status has 32 bits although it is marked as 8.
    const std::uint64_t integer = chunk.type_ == Chunk::Type_Status ? 4 : integer_size(chunk);
    skip_elements(chunk, dimensions(chunk) * (floats ? float_size(chunk) : integer));
    if (chunk.entity_ == Chunk::Entity_Vertex && chunk.type_ == Chunk::Type_Texcoord) {
      note("texture coordinates are dropped");
    } else if (chunk.type_ == Chunk::Type_Color) {
      note(chunk.entity_ == Chunk::Entity_Vertex ? "colours of other than three bytes are dropped"
                                                 : "the colours of faces and edges are dropped");
    }
  }

  // Asks that there be `size` bytes for every element of the chunk's kind.
  void skip_elements(const Chunk::Header& chunk, std::uint64_t size) {
    constexpr std::array<std::string_view, 8> kEntities{"vertex", "mesh", "face",      "",
                                                        "edge",   "",     "half-edge", ""};
    if (count(chunk) > reader_.left() / size) {
      refuse(fmt::format("the file ends at {} {} of {}", kEntities[chunk.entity_], reader_.left() / size,
                         count(chunk)));
    }
    if (count(chunk) > kMostElements)
      refuse(fmt::format("it has more than 2^31 {}s", kEntities[chunk.entity_]));
    reader_.take_bytes(static_cast<std::size_t>(count(chunk) * size));
  }

  std::uint64_t count(const Chunk::Header& chunk) const {
    switch (chunk.entity_) {
      case Chunk::Entity_Vertex:
        return vertices();
      case Chunk::Entity_Mesh:
        return 1;
      case Chunk::Entity_Face:
        return faces();
      case Chunk::Entity_Edge:
        return checked_.header.n_edges_;
      case Chunk::Entity_Halfedge:
        return 2 * std::uint64_t{checked_.header.n_edges_};
      default:
        refuse(fmt::format("unknown kind of element {}", unsigned{chunk.entity_}));
    }
  }

  std::uint64_t float_size(const Chunk::Header& chunk) const {
    if (!chunk.float_ || chunk.bits_ > Chunk::Float_64) refuse("a number has an unknown type");
    return chunk.bits_ == Chunk::Float_32 ? sizeof(float) : sizeof(double);
  }

  // The format has integers of 64 bits, and OpenMesh throws at them.
  std::uint64_t integer_size(const Chunk::Header& chunk) const {
    if (chunk.bits_ > Chunk::Integer_32) refuse("a number has an unknown type");
    return std::uint64_t{1} << chunk.bits_;
  }

  std::string read_string() {
    if (reader_.left() < 1) refuse("the file ends in a name");
    const std::size_t size = reader_.take<std::uint8_t>();
    if (reader_.left() < size) refuse("the file ends in a name");
    return std::string(reader_.take_bytes(size));
  }

  void note(std::string text) { checked_.notes.push_back(std::move(text)); }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", name_, what));
  }

  std::string_view bytes_;
  ByteReader reader_;
  const std::string& name_;
  CheckedOm checked_{};
  std::size_t begin_ = 0;                             // of the chunk that is looked at
  std::vector<std::pair<unsigned, unsigned>> taken_;  // entities and types of chunks
};

}  // namespace

CheckedOm check_om(std::string_view bytes, const std::string& name) {
  return OmCheck(bytes, name).check();
}

}  // namespace solidnoise
