#include "solidnoise/mesh/texture_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {
namespace {

double cross(const Vec<2>& a, const Vec<2>& b) {
  return a.x * b.y - a.y * b.x;
}

// A triangle's edges in the plane of textures and in space.
struct PlacedEdges {
  Vec<2> first;
  Vec<2> second;
  Vec<3> first_in_space;
  Vec<3> second_in_space;

  PlacedEdges(const TextureTriangle& triangle, const PolygonMesh& mesh)
      : first(triangle.places[1] - triangle.places[0]),
        second(triangle.places[2] - triangle.places[0]),
        first_in_space(mesh.positions[triangle.vertices[1]] - mesh.positions[triangle.vertices[0]]),
        second_in_space(mesh.positions[triangle.vertices[2]] - mesh.positions[triangle.vertices[0]]) {}

  double area() const { return 0.5 * cross(first, second); }
  double area_in_space() const { return 0.5 * glm::length(glm::cross(first_in_space, second_in_space)); }
  // Derivatives of the position by u and by v.
  Vec<3> along_u() const {
    return (first_in_space * second.y - second_in_space * first.y) / cross(first, second);
  }
  Vec<3> along_v() const {
    return (second_in_space * first.x - first_in_space * second.x) / cross(first, second);
  }
  // The greatest length of what is of length 1 in the plane of textures.
  double stretch() const {
    const Vec<3> u = along_u();
    const Vec<3> v = along_v();
    const double half_sum = 0.5 * (glm::dot(u, u) + glm::dot(v, v));
    const double half_difference = 0.5 * (glm::dot(u, u) - glm::dot(v, v));
    return std::sqrt(half_sum + std::hypot(half_difference, glm::dot(u, v)));
  }
};

void require_place(const Vec<2>& place, std::size_t face, TextureTiles tiles) {
  constexpr double kMargin = 1e-6;  // rounding of coordinates in files
  const double columns = tiles == TextureTiles::one ? 1.0 : kUdimColumns;
  const double rows = tiles == TextureTiles::one ? 1.0 : kMostUdimRows;
  if (place.x >= -kMargin && place.y >= -kMargin && place.x <= columns + kMargin && place.y <= rows + kMargin)
    return;
  if (tiles == TextureTiles::one) {
    throw std::invalid_argument(fmt::format(
        "texture coordinates of face {} are {:.6g} {:.6g}; they must be from 0 to 1, or the textures' "
        "name have <UDIM> in it",
        face, place.x, place.y));
  }
  throw std::invalid_argument(fmt::format(
      "texture coordinates of face {} are {:.6g} {:.6g}; they must be from 0 to 10, UDIM's 1001 to "
      "1100",
      face, place.x, place.y));
}

// Polygons as fans around their first corners.
std::vector<TextureTriangle> cut(const PolygonMesh& mesh, std::span<const Vec<2>> corners,
                                 TextureTiles tiles) {
  std::vector<TextureTriangle> triangles;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::size_t first = mesh.face_starts[face];
    const std::size_t end = mesh.face_starts[face + 1];
    for (std::size_t corner = first; corner < end; ++corner) require_place(corners[corner], face, tiles);
    for (std::size_t corner = first + 1; corner + 1 < end; ++corner) {
      triangles.push_back({{mesh.corners[first], mesh.corners[corner], mesh.corners[corner + 1]},
                           {corners[first], corners[corner], corners[corner + 1]},
                           {},
                           false});
    }
  }
  return triangles;
}

// Of no less than a millionth of a texel.
bool has_area(const TextureTriangle& triangle, const PolygonMesh& mesh, double size) {
  const PlacedEdges edges(triangle, mesh);
  return std::abs(edges.area()) * size * size > 1e-6 && edges.area_in_space() > 0.0;
}

void set_deviations(TexturePlan& plan) {
  constexpr double kTexelShare = 0.5;
  const PolygonMesh& mesh = plan.bake.mesh;
  const SurfaceMesh surface(mesh);
  std::vector<double> sums(surface.point_count());
  std::vector<double> areas(surface.point_count());
  for (const TextureTriangle& triangle : plan.triangles) {
    const PlacedEdges edges(triangle, mesh);
    const double area = edges.area_in_space();
    for (const std::uint32_t vertex : triangle.vertices) {
      sums[surface.point_of(vertex)] += area * edges.stretch();
      areas[surface.point_of(vertex)] += area;
    }
  }
  plan.deviations.resize(mesh.positions.size());
  for (std::size_t v = 0; v < plan.deviations.size(); ++v) {
    const std::uint32_t p = surface.point_of(v);
    const double stretch = areas[p] > 0.0 ? sums[p] / areas[p] : 0.0;
    plan.deviations[v] = static_cast<float>(kTexelShare * stretch / plan.options.size);
  }
}

double angle_at(const TextureTriangle& triangle, const PolygonMesh& mesh, std::size_t corner) {
  const Vec<3>& here = mesh.positions[triangle.vertices[corner]];
  const Vec<3> a = mesh.positions[triangle.vertices[(corner + 1) % 3]] - here;
  const Vec<3> b = mesh.positions[triangle.vertices[(corner + 2) % 3]] - here;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void set_tangents(TexturePlan& plan) {
  using FrameCorner = std::tuple<std::uint32_t, double, double, bool>;
  std::map<FrameCorner, Vec<3>> sums;
  const auto corner_of = [](const TextureTriangle& triangle, std::size_t i) {
    return FrameCorner{triangle.vertices[i], triangle.places[i].x, triangle.places[i].y, triangle.mirrored};
  };
  for (TextureTriangle& triangle : plan.triangles) {
    const PlacedEdges edges(triangle, plan.bake.mesh);
    triangle.mirrored = edges.area() < 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec<3>& normal = plan.bake.guides.normals[triangle.vertices[i]];
      const Vec<3> along = edges.along_u() - glm::dot(edges.along_u(), normal) * normal;
      const double length = glm::length(along);
      if (length == 0.0) continue;
      sums[corner_of(triangle, i)] += angle_at(triangle, plan.bake.mesh, i) / length * along;
    }
  }
  for (TextureTriangle& triangle : plan.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = sums.find(corner_of(triangle, i));
      const double length = found == sums.end() ? 0.0 : glm::length(found->second);
      triangle.tangents[i] = length > 0.0 ? found->second / length : Vec<3>(0.0);
    }
  }
}

// Tiles that a triangle's inside is in: one whose side it lies along is none.
void set_tiles(TexturePlan& plan, TextureTiles tiles) {
  constexpr double kMargin = 1e-6;
  const int columns = tiles == TextureTiles::one ? 1 : kUdimColumns;
  const int rows = tiles == TextureTiles::one ? 1 : kMostUdimRows;
  std::map<int, std::vector<std::uint32_t>> triangles;
  for (std::size_t i = 0; i < plan.triangles.size(); ++i) {
    const auto& [a, b, c] = plan.triangles[i].places;
    const Vec<2> lower(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}));
    const Vec<2> upper(std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}));
    const auto range = [](double from, double to, int count) {
      return std::pair(std::clamp(static_cast<int>(std::floor(from + kMargin)), 0, count - 1),
                       std::clamp(static_cast<int>(std::ceil(to - kMargin)) - 1, 0, count - 1));
    };
    const auto [left, right] = range(lower.x, upper.x, columns);
    const auto [bottom, top] = range(lower.y, upper.y, rows);
    for (int row = bottom; row <= top; ++row) {
      for (int column = left; column <= right; ++column) {
        triangles[kFirstUdim + kUdimColumns * row + column].push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  for (auto& [udim, inside] : triangles) plan.tiles.push_back({udim, std::move(inside)});
}

}  // namespace

Vec<2> TexturePlan::corner_of(const TextureTile& tile) const {
  const int number = tile.udim - kFirstUdim;
  return {number % kUdimColumns, number / kUdimColumns};
}

double TexturePlan::most_deviation() const {
  return deviations.empty() ? 0.0 : *std::max_element(deviations.begin(), deviations.end());
}

TexturePlan plan_textures(BakePlan bake, std::span<const Vec<2>> corners, TextureTiles tiles,
                          const TextureOptions& options) {
  require_fields(options);
  if (corners.size() != bake.mesh.corners.size()) {
    throw std::invalid_argument(
        fmt::format("there are texture coordinates for {} corners of faces; there are {}", corners.size(),
                    bake.mesh.corners.size()));
  }
  TexturePlan plan;
  plan.options = options;
  plan.triangles = cut(bake.mesh, corners, tiles);
  plan.bake = std::move(bake);
  plan.bake.bounds = place_bounds(plan.bake.mesh.positions);
  plan.without_area = std::erase_if(plan.triangles, [&](const TextureTriangle& triangle) {
    return !has_area(triangle, plan.bake.mesh, options.size);
  });
  if (plan.triangles.empty()) {
    throw std::invalid_argument("none of the faces has an area in its texture coordinates");
  }
  for (const TextureTriangle& triangle : plan.triangles) {
    plan.texels += std::abs(PlacedEdges(triangle, plan.bake.mesh).area()) * options.size * options.size;
  }
  set_deviations(plan);
  set_tangents(plan);
  set_tiles(plan, tiles);
  return plan;
}

}  // namespace solidnoise
