#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// The number types that mesh files know.
enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// A number that each vertex has, as a file names it: nx, red, quality, ...
struct VertexProperty {
  std::string name;
  ScalarType type = ScalarType::float32;  // how a file stores it
  std::vector<double> values;             // one per vertex
};

// What files call the parts of a normal and of a colour.
inline constexpr std::array<std::string_view, 3> kNormalNames{"nx", "ny", "nz"};
inline constexpr std::array<std::string_view, 4> kColorNames{"red", "green", "blue", "alpha"};

// A mesh as a file has it: indexed vertices and polygons, in the file's order, whether or not they make a
// surface. Nothing is renumbered or repaired.
struct PolygonMesh {
  std::vector<Vec<3>> positions;              // world units
  std::vector<std::uint32_t> face_starts{0};  // where each face begins in `corners`, and the end of the last
  std::vector<std::uint32_t> corners;         // vertex indices, face after face
  std::vector<VertexProperty> properties;     // in the file's order
  ScalarType position_type = ScalarType::float32;  // or float64: as exactly as a file is to store them

  std::size_t face_count() const { return face_starts.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t index) const {
    return std::span(corners).subspan(face_starts[index], face_starts[index + 1] - face_starts[index]);
  }

  void add_face(std::span<const std::uint32_t> vertices);

  // The property of this name, or null.
  const VertexProperty* property(std::string_view name) const;
  // Puts a property in the place of the one of its name, or after all others.
  void set_property(VertexProperty property);
};

using Triangle = std::array<std::uint32_t, 3>;

// The mesh's faces cut into triangles, in order, each polygon as a fan around its first corner. Faces of less
// than three corners give none.
std::vector<Triangle> triangulate(const PolygonMesh& mesh);

inline constexpr std::array<std::string_view, 2> kTextureNames{"s", "t"};

// Colours as text files have them: a row of red, green, blue, alpha per vertex.
using TextColor = std::array<double, 4>;
// What is not in the text is not a number.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
inline constexpr TextColor kNoColor{kNoNumber, kNoNumber, kNoNumber, kNoNumber};

// A property of type float32 of numbers from a text, which are rounded to it.
VertexProperty text_property(std::string_view name, std::vector<double> values);

// Adds the first `channels` columns as properties: of type uint8 if all are whole numbers up to 255 and one
// of them is above 1, otherwise float32. What is not a number becomes the largest: white, opaque.
void add_text_colors(PolygonMesh& mesh, const std::vector<TextColor>& colors, std::size_t channels);

// The mesh's colours, channel by channel: none, or red green blue, or these and alpha.
std::vector<const VertexProperty*> color_channels(const PolygonMesh& mesh);

// The mesh's normals, part by part: nx ny nz, or none.
std::vector<const VertexProperty*> normal_parts(const PolygonMesh& mesh);

// The mesh's texture coordinates: s t, or none.
std::vector<const VertexProperty*> texture_coordinates(const PolygonMesh& mesh);

// A channel's value at a vertex, with the type's largest integer as 1; floats are as they are.
double unit_color(const VertexProperty& channel, std::size_t vertex);

// The same as 0 to 255, rounded; what is outside is clamped.
std::uint8_t byte_color(const VertexProperty& channel, std::size_t vertex);

}  // namespace solidnoise
