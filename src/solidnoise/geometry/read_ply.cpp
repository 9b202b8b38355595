#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/ply_header.h"
#include "solidnoise/geometry/ply_rows.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

bool is_corner_list(const PlyProperty& property) {
  return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// By ourselves: OpenMesh's reader rounds float colours to 8 bits and wraps those above 1, keeps scalars of
// known types only, reads no triangle strips, and crashes where a header is damaged.

// Reads what follows the header; Rows is PlyTextRows or PlyBinaryRows.
template <typename Rows>
class BodyReader {
 public:
  BodyReader(std::string_view body, const std::string& name, const PlyHeader& header)
      : rows_(body, name, header), name_(name), header_(header) {
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") vertex_count_ = element.count;
    }
    if (vertex_count_ > kMostVertices) refuse_element("vertex", vertex_count_, kMostVertices);
  }

  MeshReading read() {
    for (const PlyElement& element : header_.elements) {
      require_room(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        skip_element(element);
      }
    }
    if (!rows_.at_end()) note("what follows the last element is ignored");
    return std::move(reading_);
  }

 private:
  // Every row is at least as long as its lists' lengths and its other values, so that a count that the file
  // cannot hold is known before any memory is asked for.
  void require_room(const PlyElement& element) const {
    const std::uint64_t row = Rows::smallest_row(element);
    if (row == 0) return;
    const std::uint64_t room = rows_.left() / row;
    if (element.count > room) refuse_element(element.name, element.count, room);
  }

  [[noreturn]] void refuse_element(const std::string& element, std::uint64_t count,
                                   std::uint64_t room) const {
    throw std::runtime_error(fmt::format("{}: the header promises {} of element {}, but there is room for {}",
                                         name_, count, printable(element), room));
  }

  void read_vertices(const PlyElement& element) {
    PolygonMesh& mesh = reading_.mesh;

    // Where each value goes; null for lists, which are dropped.
    struct Column {
      const PlyProperty* property;
      int axis = -1;
      std::size_t kept = 0;
    };
    std::vector<Column> columns;
    std::array<bool, 3> has_axis{};
    for (const PlyProperty& property : element.properties) {
      Column column{&property};
      if (property.count_type) {
        note(fmt::format("the vertices' lists '{}' are dropped", printable(property.name)));
      } else if (property.name == "x" || property.name == "y" || property.name == "z") {
        column.axis = property.name[0] - 'x';
        has_axis[static_cast<std::size_t>(column.axis)] = true;
        // 32-bit integers, too, need more than a float32.
        if (size_of(property.type) > 4 || property.type == ScalarType::int32 ||
            property.type == ScalarType::uint32) {
          mesh.position_type = ScalarType::float64;
        }
      } else {
        column.kept = mesh.properties.size();
        mesh.properties.push_back({property.name, property.type, {}});
      }
      columns.push_back(column);
    }
    if (has_axis != std::array{true, true, true}) {
      throw std::runtime_error(fmt::format("{}: the vertices have no x, y and z", name_));
    }
    // Vertices that have these are no more than there is room for.
    const auto count = static_cast<std::size_t>(element.count);
    mesh.positions.resize(count);
    for (VertexProperty& property : mesh.properties) property.values.resize(count);

    for (std::size_t i = 0; i < count; ++i) {
      rows_.begin_row(element, i);
      for (const Column& column : columns) {
        if (column.property->count_type) {
          skip_list(*column.property);
          continue;
        }
        const double value = rows_.take(column.property->type);
        if (column.axis < 0) {
          mesh.properties[column.kept].values[i] = value;
        } else if (std::isfinite(value)) {
          mesh.positions[i][column.axis] = value;
        } else {
          rows_.refuse(fmt::format("its {} is not finite", column.property->name));
        }
      }
      rows_.end_row();
    }
  }

  void read_faces(const PlyElement& element) {
    require_corner_list(element);
    note_dropped(element);
    reading_.mesh.face_starts.reserve(static_cast<std::size_t>(element.count) + 1);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      read_corner_row(element, i);
      for (const std::int64_t corner : corners_) reading_.mesh.corners.push_back(checked(corner));
      reading_.mesh.face_starts.push_back(static_cast<std::uint32_t>(reading_.mesh.corners.size()));
    }
  }

  // A strip's every three neighbours are a triangle, every other one the other way around; -1 begins a new
  // strip.
  void read_strips(const PlyElement& element) {
    require_corner_list(element);
    note_dropped(element);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      read_corner_row(element, i);
      std::size_t begin = 0;
      for (std::size_t k = 0; k < corners_.size(); ++k) {
        if (corners_[k] == -1) {
          begin = k + 1;
          continue;
        }
        const std::uint32_t last = checked(corners_[k]);
        if (k < begin + 2) continue;
        const bool turned = (k - begin) % 2 == 1;
        const auto first = static_cast<std::uint32_t>(corners_[turned ? k - 1 : k - 2]);
        const auto second = static_cast<std::uint32_t>(corners_[turned ? k - 2 : k - 1]);
        reading_.mesh.add_face(std::array{first, second, last});
      }
    }
  }

  void require_corner_list(const PlyElement& element) const {
    const auto& properties = element.properties;
    if (element.count == 0 || std::any_of(properties.begin(), properties.end(), is_corner_list)) return;
    throw std::runtime_error(fmt::format("{}: element {} has no list vertex_indices", name_, element.name));
  }

  // Reads a row into corners_.
  void read_corner_row(const PlyElement& element, std::uint64_t index) {
    rows_.begin_row(element, index);
    for (const PlyProperty& property : element.properties) {
      if (!is_corner_list(property)) {
        skip_property(property);
        continue;
      }
      corners_.resize(list_length(property));
      for (std::int64_t& corner : corners_) {
        const double number = rows_.take(property.type);
        // Beyond this no vertex can be, and any number can be converted.
        constexpr double kFar = 1e15;
        if (!(std::abs(number) < kFar) || number != std::floor(number)) {
          rows_.refuse(fmt::format("{} is not a vertex", number));
        }
        corner = static_cast<std::int64_t>(number);
      }
    }
    rows_.end_row();
  }

  std::uint32_t checked(std::int64_t corner) const {
    if (corner < 0 || static_cast<std::uint64_t>(corner) >= vertex_count_) {
      rows_.refuse(fmt::format("it has vertex {}, but there are {} vertices", corner, vertex_count_));
    }
    return static_cast<std::uint32_t>(corner);
  }

  std::size_t list_length(const PlyProperty& property) {
    const double length = rows_.take(*property.count_type);
    if (length < 0 || length * static_cast<double>(Rows::smallest_value(property.type)) >
                          static_cast<double>(rows_.left_in_row())) {
      rows_.refuse(fmt::format("a list of {} values is more than there is", length));
    }
    return static_cast<std::size_t>(length);
  }

  void skip_list(const PlyProperty& property) {
    for (std::size_t left = list_length(property); left > 0; --left) rows_.take(property.type);
  }

  void skip_property(const PlyProperty& property) {
    if (property.count_type) {
      skip_list(property);
    } else {
      rows_.take(property.type);
    }
  }

  void skip_element(const PlyElement& element) {
    note(fmt::format("element {} ({} of it) is dropped", printable(element.name), element.count));
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows_.begin_row(element, i);
      for (const PlyProperty& property : element.properties) skip_property(property);
      rows_.end_row();
    }
  }

  void note_dropped(const PlyElement& element) {
    std::string names;
    for (const PlyProperty& property : element.properties) {
      if (!is_corner_list(property)) names += (names.empty() ? "" : ", ") + printable(property.name);
    }
    if (!names.empty()) note(fmt::format("properties of element {} are dropped: {}", element.name, names));
  }

  void note(std::string text) { reading_.notes.push_back(std::move(text)); }

  Rows rows_;
  const std::string& name_;
  const PlyHeader& header_;
  std::uint64_t vertex_count_ = 0;
  MeshReading reading_;
  std::vector<std::int64_t> corners_;  // of a row
};

}  // namespace

MeshReading read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  const std::string_view body = bytes.substr(header.bytes);
  MeshReading reading = header.encoding == PlyEncoding::ascii
                            ? BodyReader<PlyTextRows>(body, name, header).read()
                            : BodyReader<PlyBinaryRows>(body, name, header).read();
  reading.comments = header.comments;
  if (header.has_info) reading.notes.emplace_back("lines of obj_info become comments");
  return reading;
}

}  // namespace solidnoise
