#include "solidnoise/mesh/vertex_parameters.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/mesh/direction_field.h"

namespace solidnoise {
namespace {

const std::vector<double>& attribute_of(const PolygonMesh& mesh, const std::string& name) {
  if (const VertexProperty* const property = mesh.property(name)) return property->values;
  std::vector<std::string> names;
  for (const VertexProperty& property : mesh.properties) names.push_back(property.name);
  throw std::invalid_argument(
      fmt::format("attribute is {}; the vertices have {}", name,
                  names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

double larger(double k1, double k2) {
  return std::abs(k1) >= std::abs(k2) ? k1 : k2;
}

std::vector<Vec<3>> make_directions(const SurfaceMesh& surface, const Curvature& curvature,
                                    const DirectionRecipe& recipe) {
  if (recipe.source == DirectionRecipe::Source::axis) return axis_directions(surface, recipe.axis);
  const PrincipalDirection which = recipe.source == DirectionRecipe::Source::max_curvature
                                       ? PrincipalDirection::larger
                                       : PrincipalDirection::smaller;
  return curvature_directions(surface, curvature, which, recipe.smooth);
}

}  // namespace

std::vector<double> vertex_areas(const SurfaceMesh& surface) {
  std::vector<double> vertices_at(surface.point_count(), 0.0);
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) vertices_at[surface.point_of(v)] += 1.0;
  std::vector<double> areas(surface.vertex_count());
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const std::uint32_t point = surface.point_of(v);
    areas[v] = surface.areas()[point] / vertices_at[point];
  }
  return areas;
}

std::vector<double> steering_numbers(const PolygonMesh& mesh, const Curvature& curvature,
                                     const Steering& steering, UpAxis up) {
  const SteeringSource source = steering.source;
  if (source == SteeringSource::attribute) return attribute_of(mesh, steering.attribute);
  std::vector<double> numbers(mesh.positions.size());
  if (source == SteeringSource::height) {
    const int axis = up == UpAxis::y ? 1 : 2;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = mesh.positions[i][axis];
    return numbers;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double k1 = curvature.k1[i];
    const double k2 = curvature.k2[i];
    if (source == SteeringSource::mean_curvature) numbers[i] = 0.5 * (k1 + k2);
    if (source == SteeringSource::gaussian_curvature) numbers[i] = k1 * k2;
    if (source == SteeringSource::max_curvature) numbers[i] = larger(k1, k2);
    if (source == SteeringSource::abs_curvature) numbers[i] = std::sqrt(0.5 * (k1 * k1 + k2 * k2));
  }
  return numbers;
}

VertexGuides measure_guides(const PolygonMesh& mesh, const SurfaceMesh& surface, const BakeRecipe& recipe) {
  VertexGuides guides;
  guides.normals = surface.to_vertices(surface.normals());
  const bool oriented = has_direction(recipe.noise);
  const bool steered_by_curvature = recipe.steers() && recipe.by.source != SteeringSource::attribute &&
                                    recipe.by.source != SteeringSource::height;
  const bool directed_by_curvature = oriented && recipe.direction.source != DirectionRecipe::Source::axis;
  Curvature curvature;
  if (steered_by_curvature || directed_by_curvature) {
    curvature = measure_curvature(surface, {.rounds = recipe.smooth, .radius = recipe.smooth_radius});
  }
  if (oriented) guides.directions = make_directions(surface, curvature, recipe.direction);
  if (recipe.steers()) {
    guides.numbers = steering_numbers(mesh, curvature, recipe.by, recipe.up);
    guides.steering = make_weights(guides.numbers, recipe.by, vertex_areas(surface));
  }
  return guides;
}

VertexParameters make_parameters(const BakeRecipe& recipe, const ParameterRange& frequency,
                                 const std::vector<float>& weights) {
  return {steer(frequency, Interpolation::logarithmic, weights),
          steer(recipe.bandwidth, Interpolation::linear, weights),
          steer(recipe.magnitude, Interpolation::linear, weights),
          steer(recipe.bias, Interpolation::linear, weights)};
}

}  // namespace solidnoise
