#include "solidnoise/geometry/polygon_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "solidnoise/geometry/scalar_type.h"

namespace solidnoise {

void PolygonMesh::add_face(std::span<const std::uint32_t> vertices) {
  corners.insert(corners.end(), vertices.begin(), vertices.end());
  face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
}

const VertexProperty* PolygonMesh::property(std::string_view name) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const VertexProperty& property) { return property.name == name; });
  return found == properties.end() ? nullptr : &*found;
}

void PolygonMesh::set_property(VertexProperty property) {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const VertexProperty& other) { return other.name == property.name; });
  if (found == properties.end()) {
    properties.push_back(std::move(property));
  } else {
    *found = std::move(property);
  }
}

std::vector<Triangle> triangulate(const PolygonMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.corners.size());
  for (std::size_t index = 0; index < mesh.face_count(); ++index) {
    const auto face = mesh.face(index);
    for (std::size_t i = 2; i < face.size(); ++i) triangles.push_back({face[0], face[i - 1], face[i]});
  }
  return triangles;
}

namespace {

// The properties of these names, up to the first that is not there.
std::vector<const VertexProperty*> find_properties(const PolygonMesh& mesh,
                                                   std::span<const std::string_view> names) {
  std::vector<const VertexProperty*> found;
  for (const std::string_view name : names) {
    const VertexProperty* const property = mesh.property(name);
    if (property == nullptr) break;
    found.push_back(property);
  }
  return found;
}

}  // namespace

VertexProperty text_property(std::string_view name, std::vector<double> values) {
  for (double& value : values) value = static_cast<double>(nearest_float(value));
  return {std::string(name), ScalarType::float32, std::move(values)};
}

void add_text_colors(PolygonMesh& mesh, const std::vector<TextColor>& colors, std::size_t channels) {
  bool whole = true;
  bool above_one = false;
  for (const TextColor& color : colors) {
    for (std::size_t c = 0; c < channels; ++c) {
      if (std::isnan(color[c])) continue;
      whole = whole && color[c] >= 0.0 && color[c] <= 255.0 && color[c] == std::floor(color[c]);
      above_one = above_one || color[c] > 1.0;
    }
  }
  const bool bytes = whole && above_one;
  const double largest = bytes ? 255.0 : 1.0;
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<double> values;
    values.reserve(colors.size());
    for (const TextColor& color : colors) values.push_back(std::isnan(color[c]) ? largest : color[c]);
    mesh.properties.push_back(text_property(kColorNames[c], std::move(values)));
    if (bytes) mesh.properties.back().type = ScalarType::uint8;
  }
}

std::vector<const VertexProperty*> color_channels(const PolygonMesh& mesh) {
  std::vector<const VertexProperty*> channels = find_properties(mesh, kColorNames);
  if (channels.size() < 3) channels.clear();
  return channels;
}

std::vector<const VertexProperty*> normal_parts(const PolygonMesh& mesh) {
  std::vector<const VertexProperty*> parts = find_properties(mesh, kNormalNames);
  if (parts.size() < 3) parts.clear();
  return parts;
}

std::vector<const VertexProperty*> texture_coordinates(const PolygonMesh& mesh) {
  std::vector<const VertexProperty*> parts = find_properties(mesh, kTextureNames);
  if (parts.size() < 2) parts.clear();
  return parts;
}

double unit_color(const VertexProperty& channel, std::size_t vertex) {
  const double value = channel.values[vertex];
  return visit_scalar_type(channel.type, [value](auto number) {
    using Limits = std::numeric_limits<decltype(number)>;
    return Limits::is_integer ? value / static_cast<double>(Limits::max()) : value;
  });
}

std::uint8_t byte_color(const VertexProperty& channel, std::size_t vertex) {
  const double value = unit_color(channel, vertex);
  if (!(value > 0.0)) return 0;  // nor what is not a number
  return static_cast<std::uint8_t>(std::lround(255.0 * std::min(value, 1.0)));
}

}  // namespace solidnoise
