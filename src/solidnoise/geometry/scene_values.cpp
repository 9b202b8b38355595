#include "solidnoise/geometry/scene_values.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();

bool has_direction(const Vec<3>& vector) {
  const double length = glm::length(vector);
  return std::isfinite(length) && length > 0.0;
}

template <std::size_t Count>
bool is_one_of(std::string_view name, const std::array<std::string_view, Count>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

double float_value(double value) {
  if (!std::isfinite(value)) return 0.0;
  return static_cast<float>(std::clamp(value, -kLargestFloat, kLargestFloat));
}

double linear_color(const VertexProperty& channel, std::size_t vertex) {
  const double encoded = std::clamp(float_value(unit_color(channel, vertex)), 0.0, 1.0);
  if (channel.name == kColorNames[3]) return encoded;
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::vector<Vec<3>> unit_normals(const PolygonMesh& mesh) {
  std::vector<Vec<3>> normals(mesh.positions.size(), Vec<3>(0.0));
  for (const Triangle& triangle : triangulate(mesh)) {
    const Vec<3>& a = mesh.positions[triangle[0]];
    const Vec<3> normal = glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
    if (!has_direction(normal)) continue;
    for (const std::uint32_t corner : triangle) normals[corner] += normal;
  }
  const std::vector<const VertexProperty*> parts = normal_parts(mesh);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    Vec<3>& normal = normals[v];
    if (!parts.empty()) {
      const Vec<3> own{parts[0]->values[v], parts[1]->values[v], parts[2]->values[v]};
      if (has_direction(own)) normal = own;
    }
    normal = has_direction(normal) ? glm::normalize(normal) : Vec<3>(0.0, 1.0, 0.0);
  }
  return normals;
}

std::vector<const VertexProperty*> plain_numbers(const PolygonMesh& mesh) {
  const bool has_colors = !color_channels(mesh).empty();
  const bool has_normals = !normal_parts(mesh).empty();
  const bool has_texture = !texture_coordinates(mesh).empty();
  std::vector<const VertexProperty*> result;
  for (const VertexProperty& property : mesh.properties) {
    if (has_colors && is_one_of(property.name, kColorNames)) continue;
    if (has_normals && is_one_of(property.name, kNormalNames)) continue;
    if (has_texture && is_one_of(property.name, kTextureNames)) continue;
    result.push_back(&property);
  }
  return result;
}

std::vector<SceneNumber> plain_vectors(const PolygonMesh& mesh) {
  const std::vector<const VertexProperty*> numbers = plain_numbers(mesh);
  std::vector<SceneNumber> result;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string& name = numbers[i]->name;
    const std::string stem = name.ends_with("_x") ? name.substr(0, name.size() - 2) : std::string();
    if (!stem.empty() && i + 2 < numbers.size() && numbers[i + 1]->name == stem + "_y" &&
        numbers[i + 2]->name == stem + "_z") {
      result.push_back({stem, {numbers[i], numbers[i + 1], numbers[i + 2]}});
      i += 2;
    } else {
      result.push_back({name, {numbers[i]}});
    }
  }
  return result;
}

FloatBox float_box(const PolygonMesh& mesh) {
  FloatBox box{Vec<3>(kLargestFloat), Vec<3>(-kLargestFloat)};
  for (const Vec<3>& position : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], float_value(position[axis]));
      box.upper[axis] = std::max(box.upper[axis], float_value(position[axis]));
    }
  }
  return box;
}

std::string usd_name(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    result += std::isalnum(letter) != 0 && letter < 0x80 ? c : '_';
  }
  const bool fits = !result.empty() && std::isdigit(static_cast<unsigned char>(result.front())) == 0;
  return fits ? result : "_" + result;
}

std::string quoted_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < ' ') {
      result += ' ';
    } else {
      result += byte < 0x7f ? c : '?';
    }
  }
  return result + '"';
}

void require_float_positions(const PolygonMesh& mesh, std::string_view format) {
  for (const Vec<3>& p : mesh.positions) {
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kLargestFloat) continue;
    throw std::invalid_argument(fmt::format(
        "a vertex is at ({}, {}, {}), beyond the numbers of {}; PLY holds it", p.x, p.y, p.z, format));
  }
}

}  // namespace solidnoise
