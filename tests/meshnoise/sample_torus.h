#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "support/surfaces.h"
#include "tools/run_tool.h"

namespace solidnoise {

// An irregular torus around the y axis, of radii 1 and 0.4, whose positions are multiples of a step: those of
// 2^-14 any format can hold, and those of 2^-7, of 7 decimals, mean the same double as text, too.
inline PolygonMesh sample_torus(int n = 14, double step = 0x1p-14) {
  PolygonMesh mesh = torus_mesh(1.0, 0.4, {.n = n, .jitter = 0.3});
  for (Vec<3>& p : mesh.positions) p = step * glm::round(p / step);
  return mesh;
}

// The same with numbers of the vertices: heat, a float64 from 0 to 1, and an integer label.
inline PolygonMesh torus_with_numbers() {
  PolygonMesh mesh = sample_torus();
  VertexProperty heat{"heat", ScalarType::float64, {}};
  VertexProperty label{"label", ScalarType::int16, {}};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    heat.values.push_back(static_cast<double>(v) / static_cast<double>(mesh.positions.size() - 1));
    label.values.push_back(static_cast<double>(v % 7) - 3.0);
  }
  mesh.properties = {heat, label};
  return mesh;
}

// Puts a mesh into the folder under a name whose extension says the format.
inline void write_sample(const TemporaryFolder& folder, const std::string& name, const PolygonMesh& mesh,
                         std::vector<std::string> comments = {}) {
  write_mesh(folder.file(name), mesh, {.comments = std::move(comments)});
}

inline std::vector<std::string> property_names(const PolygonMesh& mesh) {
  std::vector<std::string> names;
  for (const VertexProperty& property : mesh.properties) names.push_back(property.name);
  return names;
}

// The numbers of a property; none if there is no such one.
inline std::vector<double> numbers_of(const PolygonMesh& mesh, const std::string& name) {
  const VertexProperty* const property = mesh.property(name);
  return property ? property->values : std::vector<double>();
}

inline double spread(const std::vector<double>& numbers) {
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  return numbers.empty() ? 0.0 : *most - *least;
}

}  // namespace solidnoise
