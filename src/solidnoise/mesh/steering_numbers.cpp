#include "solidnoise/mesh/steering_numbers.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace solidnoise {
namespace {

std::vector<double> attribute(const PolygonMesh& mesh, const std::string& name) {
  if (const VertexProperty* const property = mesh.property(name)) return property->values;
  std::string known;
  for (const VertexProperty& property : mesh.properties) {
    known += (known.empty() ? "" : ", ") + property.name;
  }
  throw std::invalid_argument(
      fmt::format("the mesh's vertices have no attribute \"{}\"; {}", name,
                  known.empty() ? std::string("they have none") : fmt::format("they have {}", known)));
}

double curvature_number(SteeringSource source, const Curvature& curvature, std::size_t v) {
  const double k1 = curvature.k1[v];
  const double k2 = curvature.k2[v];
  switch (source) {
    case SteeringSource::mean_curvature:
      return curvature.mean(v);
    case SteeringSource::gaussian_curvature:
      return curvature.gaussian(v);
    case SteeringSource::max_curvature:
      return std::abs(k1) >= std::abs(k2) ? k1 : k2;
    default:
      return std::sqrt(0.5 * (k1 * k1 + k2 * k2));
  }
}

}  // namespace

bool is_curvature(SteeringSource source) {
  return source != SteeringSource::height && source != SteeringSource::attribute;
}

std::vector<double> steering_numbers(const Steering& steering, const PolygonMesh& mesh,
                                     const Curvature& curvature, UpAxis up) {
  if (steering.source == SteeringSource::attribute) return attribute(mesh, steering.attribute);
  std::vector<double> numbers(mesh.positions.size());
  if (steering.source == SteeringSource::height) {
    const int axis = up == UpAxis::y ? 1 : 2;
    for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = mesh.positions[v][axis];
    return numbers;
  }
  if (curvature.size() != numbers.size()) {
    throw std::invalid_argument(
        fmt::format("there are {} curvatures for {} vertices", curvature.size(), numbers.size()));
  }
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    numbers[v] = curvature_number(steering.source, curvature, v);
  }
  return numbers;
}

}  // namespace solidnoise
