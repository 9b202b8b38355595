#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/mesh_importer.h"
#include "solidnoise/geometry/openmesh_session.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

constexpr std::size_t kStlHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;  // a normal and three corners of three floats each, and 16 bits
constexpr std::size_t kFirstFacet = kStlHeaderBytes + sizeof(std::uint32_t);

// A file's facets as OpenMesh's reader takes them, in bytes or in words.
struct CheckedStl {
  std::string facets;
  std::size_t count = 0;
  OpenMesh::IO::Options options;
  std::vector<std::string> notes;
};

std::uint64_t promised_facets(std::string_view bytes) {
  return ByteReader(bytes.substr(kStlHeaderBytes), std::endian::little).take<std::uint32_t>();
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

CheckedStl check_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kFirstFacet) {
    throw std::runtime_error(fmt::format("{}: is not an STL file, or ends within its header", name));
  }
  const std::uint64_t count = promised_facets(bytes);
  const std::uint64_t room = (bytes.size() - kFirstFacet) / kFacetBytes;
  if (count > room) {
    throw std::runtime_error(
        fmt::format("{}: the header promises {} facets, but there is room for {}", name, count, room));
  }
  CheckedStl checked;
  checked.count = count;
  checked.options = OpenMesh::IO::Options::Binary;
  ByteReader reader(bytes.substr(kFirstFacet), std::endian::little);
  bool has_attributes = false;
  for (std::uint64_t facet = 0; facet < count; ++facet) {
    reader.take_bytes(3 * sizeof(float));  // the normal
    for (int number = 0; number < 9; ++number) {
      if (std::isfinite(reader.take<float>())) continue;
      throw std::runtime_error(
          fmt::format("{}: face {}: a vertex has a position that is not finite", name, facet));
    }
    has_attributes = reader.take<std::uint16_t>() != 0 || has_attributes;
  }
  if (has_attributes) checked.notes.push_back("the attributes (colours) of facets are dropped");
  if (reader.left() > 0) {
    checked.notes.push_back(fmt::format("{} bytes after the last facet are ignored", reader.left()));
  }
  checked.facets = bytes.substr(0, bytes.size() - reader.left());
  return checked;
}

// solid NAME { facet normal x y z, outer loop, { vertex x y z }, endloop, endfacet } endsolid NAME, any
// number of them. OpenMesh takes every line that has the word `outer` in it, be it a part of the solid's
// name, for one that three vertices follow: it is given the loops alone.
class TextCheck {
 public:
  TextCheck(std::string_view bytes, const std::string& name) : lines_(bytes, name) {}

  CheckedStl check() {
    while (lines_.next()) {
      std::string_view text = lines_.line();
      const std::string_view keyword = take_word(text);
      if (keyword == "vertex") {
        check_vertex(text);
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
          fmt::format("{}: the file ends at face {}, before 'endsolid'", lines_.name(), checked_.count));
    }
    return std::move(checked_);
  }

 private:
  void check_vertex(std::string_view text) {
    std::array<float, 3> corner;
    for (float& number : corner) {
      const std::string_view word = take_word(text);
      const std::optional<double> parsed = parse_double(word);
      number = parsed ? nearest_float(*parsed) : 0.0f;
      if (!parsed || !std::isfinite(number)) {
        refuse(word.empty() ? std::string("a vertex needs three coordinates")
                            : fmt::format("'{}' is not a finite number", printable(word)));
      }
    }
    corners_.push_back(corner);
  }

  void end_loop() {
    if (corners_.size() != 3) refuse(fmt::format("it has {} vertices; a facet has 3", corners_.size()));
    checked_.facets += "outer loop\n";
    for (const auto& [x, y, z] : corners_) checked_.facets += fmt::format("vertex {} {} {}\n", x, y, z);
    ++checked_.count;
    corners_.clear();
  }

  [[noreturn]] void refuse(const std::string& what) const {
    lines_.refuse(fmt::format("face {}: {}", checked_.count, what));
  }

  TextLines lines_;
  CheckedStl checked_;
  std::vector<std::array<float, 3>> corners_;  // of this facet
  bool in_solid_ = false;
};

}  // namespace

// Corners at one position, to the last bit but for the sign of 0, become one vertex in OpenMesh, too.
MeshReading read_stl(std::string_view bytes, const std::string& name) {
  CheckedStl checked = is_binary(bytes) ? check_binary(bytes, name) : TextCheck(bytes, name).check();
  MeshImporter importer(name);
  {
    const OpenMeshSession session;
    std::istringstream stream(std::move(checked.facets));
    OpenMesh::IO::STLReader().read(stream, importer, checked.options);
  }
  MeshReading reading{importer.take_mesh(), {}, std::move(checked.notes)};
  if (const std::size_t dropped = checked.count - reading.mesh.face_count(); dropped > 0) {
    reading.notes.push_back(fmt::format("{} facets with two corners at one place are dropped", dropped));
  }
  return reading;
}

}  // namespace solidnoise
