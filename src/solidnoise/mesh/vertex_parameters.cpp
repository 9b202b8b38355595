#include "solidnoise/mesh/vertex_parameters.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/mesh/surface_smoothing.h"
#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {
namespace {

using Line = std::complex<double>;

Line axis_line(const TangentFrame& frame, const Vec<3>& axis) {
  const Line tangent = frame.in_frame(axis);
  return tangent == 0.0 ? 1.0 : line_at(tangent / std::abs(tangent));
}

std::vector<Vec<3>> to_directions(const SurfaceMesh& surface, const TangentFrames& frames,
                                  const std::vector<Line>& lines) {
  std::vector<Vec<3>> directions(surface.vertex_count());
  for (std::size_t v = 0; v < directions.size(); ++v) {
    const std::uint32_t p = surface.point_of(v);
    directions[v] = frames[p].in_space(direction_of_line(lines[p]));
  }
  return directions;
}

// The line of larger curvature, of a length that tells how much larger: continuous where the two are the
// same.
std::vector<Line> lines_of(const SurfaceMesh& surface, const TangentFrames& frames,
                           const Curvature& curvature) {
  std::vector<Line> lines(surface.point_count());
  for (std::size_t p = 0; p < lines.size(); ++p) {
    const std::uint32_t v = surface.vertex_at(p);
    const bool first = std::abs(curvature.k1[v]) >= std::abs(curvature.k2[v]);
    const double anisotropy = std::abs(std::abs(curvature.k1[v]) - std::abs(curvature.k2[v]));
    lines[p] =
        anisotropy * axis_line(frames[p], first ? curvature.k1_direction[v] : curvature.k2_direction[v]);
  }
  return lines;
}

// Lines below this length are rounding or the error of the curvature: 1/1000 of its root mean square, and on
// a flat mesh what bends by less than 1e-6 over the mesh's size.
double shortest_line(const SurfaceMesh& surface, const Curvature& curvature) {
  constexpr double kIsotropic = 0.02;
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t p = 0; p < surface.point_count(); ++p) {
    const double k1 = curvature.k1[surface.vertex_at(p)];
    const double k2 = curvature.k2[surface.vertex_at(p)];
    sum += surface.areas()[p] * 0.5 * (k1 * k1 + k2 * k2);
    area += surface.areas()[p];
  }
  return area > 0.0 ? std::max(kIsotropic * std::sqrt(sum / area), 1e-6 / std::sqrt(area)) : 1.0;
}

// Continues the lines that are longer than `shortest`, ring by ring: each point takes the mean of what its
// neighbours of the rings before have. Returns whether a point was reached.
std::vector<char> continue_lines(const SurfaceMesh& surface, const TangentFrames& frames, double shortest,
                                 std::vector<Line>& lines) {
  std::vector<char> known(lines.size());
  std::vector<std::uint32_t> front;
  for (std::size_t p = 0; p < lines.size(); ++p) {
    known[p] = std::abs(lines[p]) > shortest ? 1 : 0;
    if (known[p] != 0) front.push_back(static_cast<std::uint32_t>(p));
  }
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t p : front) {
      for (const std::uint32_t q : surface.neighbours(p)) {
        if (known[q] == 0) next.push_back(q);
      }
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    std::vector<Line> found(next.size());
    for (std::size_t i = 0; i < next.size(); ++i) {
      const std::uint32_t q = next[i];
      for (const std::uint32_t p : surface.neighbours(q)) {
        if (known[p] != 0) found[i] += line_at(transport(frames[p], frames[q])) * lines[p];
      }
    }
    // All of the ring before any of it counts, so that the order of points does not matter.
    for (std::size_t i = 0; i < next.size(); ++i) {
      const double length = std::abs(found[i]);
      lines[next[i]] = length > 0.0 ? shortest / length * found[i] : shortest;
      known[next[i]] = 1;
    }
    front = std::move(next);
  }
  return known;
}

}  // namespace

std::vector<Vec<3>> axis_directions(std::span<const Vec<3>> normals, const Vec<3>& axis) {
  const double length = glm::length(axis);
  if (!std::isfinite(length) || length == 0.0) {
    throw std::invalid_argument(
        fmt::format("the axis is {} {} {}; it must be finite and not 0", axis.x, axis.y, axis.z));
  }
  const TangentFrames frames(normals);
  std::vector<Vec<3>> directions(normals.size());
  for (std::size_t v = 0; v < directions.size(); ++v) {
    directions[v] = frames[v].in_space(direction_of_line(axis_line(frames[v], axis / length)));
  }
  return directions;
}

std::vector<Vec<3>> curvature_directions(const SurfaceMesh& surface, const Curvature& curvature,
                                         PrincipalDirection which, int rounds) {
  SurfaceSmoothing smoothing(surface);
  return curvature_directions(surface, smoothing, curvature, which, rounds);
}

std::vector<Vec<3>> curvature_directions(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                                         const Curvature& curvature, PrincipalDirection which, int rounds) {
  require_in_range("the rounds of smoothing", rounds, 0, 10000);
  if (curvature.size() != surface.vertex_count()) {
    throw std::invalid_argument(
        fmt::format("there are {} curvatures for {} vertices", curvature.size(), surface.vertex_count()));
  }
  const TangentFrames frames(surface.normals());
  std::vector<Line> lines = lines_of(surface, frames, curvature);
  const double shortest = shortest_line(surface, curvature);
  const auto smooth = [&] {
    for (int round = 0; round < rounds; ++round) smoothing.average(lines, surface.areas());
  };
  smooth();
  const std::vector<char> known = continue_lines(surface, frames, shortest, lines);
  for (std::size_t p = 0; p < lines.size(); ++p) {
    if (known[p] == 0) lines[p] = shortest * axis_line(frames[p], Vec<3>(0.0, 1.0, 0.0));
  }
  smooth();
  if (which == PrincipalDirection::smaller) {
    for (Line& line : lines) line = -line;  // turned by a right angle
  }
  return to_directions(surface, frames, lines);
}

namespace {

const std::vector<double>& attribute_of(const PolygonMesh& mesh, const std::string& name) {
  if (const VertexProperty* const property = mesh.property(name)) {
    const auto fits = [](double number) { return std::abs(number) <= kLargestOption; };
    const auto found = std::find_if_not(property->values.begin(), property->values.end(), fits);
    if (found == property->values.end()) return property->values;
    throw std::invalid_argument(
        fmt::format("attribute is {}; it is {} at vertex {} and must be a finite number", name, *found,
                    found - property->values.begin()));
  }
  std::vector<std::string> names;
  for (const VertexProperty& property : mesh.properties) names.push_back(property.name);
  throw std::invalid_argument(
      fmt::format("attribute is {}; the vertices have {}", name,
                  names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

double larger(double k1, double k2) {
  return std::abs(k1) >= std::abs(k2) ? k1 : k2;
}

std::vector<Vec<3>> make_directions(const SurfaceMesh& surface, SurfaceSmoothing& smoothing,
                                    std::span<const Vec<3>> planes, const Curvature& curvature,
                                    const BakeRecipe& recipe) {
  const DirectionRecipe& direction = recipe.direction;
  if (direction.source == DirectionRecipe::Source::axis) {
    return axis_directions(planes, recipe.direction_axis());
  }
  const PrincipalDirection which = direction.source == DirectionRecipe::Source::max_curvature
                                       ? PrincipalDirection::larger
                                       : PrincipalDirection::smaller;
  return curvature_directions(surface, smoothing, curvature, which, direction.smooth);
}

// Near a point around which directions turn, waves of one length would turn within a fraction of it. Smoothed
// over a feature, lines are the shorter the more of them are there; directions become those, of a length that
// rises from 0 at such a point to 1 where most of a feature agrees. In the planes that the noise lies in:
// between those of a rough surface's own normals, lines that agree would turn.
void weaken_where_they_turn(const SurfaceMesh& surface, std::span<const Vec<3>> planes, double radius,
                            Progress* progress, std::vector<Vec<3>>& directions) {
  constexpr double kMost = 0.7;
  std::vector<Vec<3>> normals(surface.point_count());
  for (std::size_t p = 0; p < normals.size(); ++p) normals[p] = planes[surface.vertex_at(p)];
  const TangentFrames frames(normals);
  std::vector<Line> lines(normals.size());
  for (std::size_t p = 0; p < lines.size(); ++p)
    lines[p] = axis_line(frames[p], directions[surface.vertex_at(p)]);
  SurfaceSmoothing(surface, normals).diffuse(lines, radius, progress);
  for (std::size_t v = 0; v < directions.size(); ++v) {
    const std::uint32_t p = surface.point_of(v);
    if (surface.triangles_at(p).empty()) continue;
    directions[v] =
        std::min(1.0, std::abs(lines[p]) / kMost) * frames[p].in_space(direction_of_line(lines[p]));
  }
}

// A picture's second axis is up in it; noise by example asks for the first, to the right as seen from
// outside.
void turn_upright(std::span<const Vec<3>> planes, std::vector<Vec<3>>& directions) {
  for (std::size_t v = 0; v < directions.size(); ++v) directions[v] = glm::cross(directions[v], planes[v]);
}

// The surface's; of vertices without faces those that the mesh says.
std::vector<Vec<3>> normals_of(const PolygonMesh& mesh, const SurfaceMesh& surface) {
  std::vector<Vec<3>> normals = surface.to_vertices(surface.normals());
  const auto parts = normal_parts(mesh);
  if (parts.empty()) return normals;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (!surface.triangles_at(surface.point_of(v)).empty()) continue;
    const Vec<3> said(parts[0]->values[v], parts[1]->values[v], parts[2]->values[v]);
    const double length = glm::length(said);
    if (std::isfinite(length) && length > 0.0) normals[v] = said / length;
  }
  return normals;
}

// Where opposite normals meet there is no plane between them, and the surface's own normal stays.
std::vector<Vec<3>> smooth_normals(const SurfaceMesh& surface, SurfaceSmoothing& smoothing, double radius,
                                   Progress* progress) {
  constexpr double kShortest = 1e-3;
  std::vector<Vec<3>> smooth = surface.normals();
  smoothing.diffuse(smooth, radius, progress);
  for (std::size_t p = 0; p < smooth.size(); ++p) {
    const double length = glm::length(smooth[p]);
    smooth[p] = length > kShortest ? smooth[p] / length : surface.normals()[p];
  }
  return surface.to_vertices(smooth);
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

CurvatureNeeded curvature_needed(const BakeRecipe& recipe) {
  const bool by_direction =
      has_direction(recipe.noise) && recipe.direction.source != DirectionRecipe::Source::axis;
  const bool by_number = recipe.steers() && recipe.by.source != SteeringSource::attribute &&
                         recipe.by.source != SteeringSource::height;
  if (by_direction) return CurvatureNeeded::all;
  if (!by_number) return CurvatureNeeded::none;
  return recipe.by.source == SteeringSource::mean_curvature ? CurvatureNeeded::mean : CurvatureNeeded::all;
}

VertexGuides measure_guides(const PolygonMesh& mesh, const SurfaceMesh& surface, const BakeRecipe& recipe,
                            const ParameterRange& frequency, Progress* progress) {
  PartialProgress stop(progress, 0.0, 0.0);  // how far it is nobody can tell
  VertexGuides guides;
  const double radius = smoothing_radius(recipe, frequency);
  std::optional<SurfaceSmoothing> smoothing(std::in_place, surface);
  guides.normals = normals_of(mesh, surface);
  if (radius > 0.0 && has_plane(recipe.noise) && !surface.triangles().empty())
    guides.smooth_normals = smooth_normals(surface, *smoothing, radius, &stop);
  const CurvatureOptions options{.rounds = recipe.smooth, .radius = radius};
  const CurvatureNeeded needed = curvature_needed(recipe);
  Curvature curvature;
  if (needed == CurvatureNeeded::mean)
    guides.numbers = measure_mean_curvature(surface, *smoothing, options, &stop);
  if (needed == CurvatureNeeded::all) curvature = measure_curvature(surface, *smoothing, options, &stop);
  if (has_direction(recipe.noise))
    guides.directions = make_directions(surface, *smoothing, guides.planes(), curvature, recipe);
  smoothing.reset();  // lines in smooth planes have one of their own
  if (recipe.noise.kind == SurfaceNoiseKind::oriented && radius > 0.0 && !surface.triangles().empty())
    weaken_where_they_turn(surface, guides.planes(), radius, &stop, guides.directions);
  if (recipe.noise.kind == SurfaceNoiseKind::spectrum) turn_upright(guides.planes(), guides.directions);
  throw_if_cancelled(progress);
  if (recipe.steers()) {
    if (needed != CurvatureNeeded::mean)
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
