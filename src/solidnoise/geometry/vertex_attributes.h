#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

inline constexpr std::array<std::string_view, 2> kTextureNames{"s", "t"};

// Colours as text files have them: a row of red, green, blue, alpha per vertex.
using TextColor = std::array<double, 4>;

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
