#include "solidnoise/mesh/bake_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "solidnoise/core/bounds.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_values.h"
#include "solidnoise/mesh/displace.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/vertex_colors.h"

namespace solidnoise {
namespace {

// Number `vertex` of a parameter.
double at(const VertexNumber& number, std::size_t vertex) {
  return number.varies() ? number.values[vertex] : number.constant;
}

double diagonal_of(const PolygonMesh& mesh) {
  const Box<3> box = bounds_of<3>(mesh.positions);
  return glm::length(box.upper - box.lower);
}

// Cycles per edge of the highest frequency, mean over all edges.
double mean_cycles_per_edge(const PolygonMesh& mesh, const VertexNumber& frequency, double highest) {
  const auto add_faces = [&](const tbb::blocked_range<std::size_t>& faces, double sum) {
    for (std::size_t index = faces.begin(); index < faces.end(); ++index) {
      const auto face = mesh.face(index);
      for (std::size_t i = 0; i < face.size(); ++i) {
        const std::uint32_t a = face[i];
        const std::uint32_t b = face[(i + 1) % face.size()];
        const double length = glm::length(mesh.positions[a] - mesh.positions[b]);
        sum += 0.5 * length * highest * (at(frequency, a) + at(frequency, b));
      }
    }
    return sum;
  };
  constexpr std::size_t kGrain = 4096;
  const double sum = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.face_count(), kGrain), 0.0, add_faces, std::plus<>());
  return mesh.corners.empty() ? 0.0 : sum / static_cast<double>(mesh.corners.size());
}

// What a keepable number needs of the recipe.
enum class Needs { nothing, steering, directions, slopes };

// What can be kept: a name, and the numbers of all vertices under one or more property names.
struct Keepable {
  std::string_view name;
  Needs needs;
  std::function<std::vector<VertexProperty>(const BakePlan&, const BakedValues&)> properties;
};

VertexProperty property_of(std::string name, std::size_t count,
                           const std::function<double(std::size_t)>& number) {
  VertexProperty property{std::move(name), ScalarType::float32, std::vector<double>(count)};
  for (std::size_t i = 0; i < count; ++i) property.values[i] = number(i);
  return property;
}

Keepable parameter(std::string_view name, VertexNumber VertexParameters::*member) {
  return {name, Needs::nothing, [=](const BakePlan& plan, const BakedValues&) {
            const VertexNumber& number = plan.parameters.*member;
            return std::vector{property_of(std::string(name), plan.mesh.positions.size(),
                                           [&](std::size_t i) { return at(number, i); })};
          }};
}

std::vector<VertexProperty> vector_properties(const std::string& name, std::size_t count,
                                              const std::function<Vec<3>(std::size_t)>& vector) {
  std::vector<VertexProperty> properties;
  for (int axis = 0; axis < 3; ++axis) {
    properties.push_back(property_of(fmt::format("{}_{}", name, "xyz"[axis]), count,
                                     [&](std::size_t i) { return vector(i)[axis]; }));
  }
  return properties;
}

const std::vector<Keepable>& keepables() {
  static const std::vector<Keepable> all{
      parameter("frequency", &VertexParameters::frequency),
      parameter("bandwidth", &VertexParameters::bandwidth),
      parameter("magnitude", &VertexParameters::magnitude),
      parameter("bias", &VertexParameters::bias),
      {"weight", Needs::steering,
       [](const BakePlan& plan, const BakedValues&) {
         const auto& weights = plan.guides.steering.weights;
         return std::vector{property_of("weight", weights.size(), [&](std::size_t i) { return weights[i]; })};
       }},
      {"steering", Needs::steering,
       [](const BakePlan& plan, const BakedValues&) {
         const auto& numbers = plan.guides.numbers;
         return std::vector{
             property_of("steering", numbers.size(), [&](std::size_t i) { return numbers[i]; })};
       }},
      {"direction", Needs::directions,
       [](const BakePlan& plan, const BakedValues&) {
         const auto& directions = plan.guides.directions;
         return vector_properties("direction", directions.size(),
                                  [&](std::size_t i) { return directions[i]; });
       }},
      {"gradient", Needs::slopes,
       [](const BakePlan&, const BakedValues& values) {
         const auto& slopes = values.slopes;
         return vector_properties("gradient", slopes.size(), [&](std::size_t i) { return slopes[i]; });
       }},
      {"curl", Needs::slopes,
       [](const BakePlan& plan, const BakedValues& values) {
         return vector_properties("curl", values.slopes.size(), [&](std::size_t i) {
           return glm::cross(plan.guides.normals[i], values.slopes[i]);
         });
       }},
  };
  return all;
}

const Keepable& find_keepable(const std::string& name) {
  for (const Keepable& keepable : keepables()) {
    if (keepable.name == name) return keepable;
  }
  throw std::invalid_argument(
      fmt::format("keep is {}; it must be one of {}", name, fmt::join(keepable_names(), ", ")));
}

// Normals between those of the parents. The normals of what is cut up would be those of flat faces, and
// the noise of the tangent plane would jump from face to face.
void carry_normals(const RefinedMesh& refined, std::vector<Vec<3>>& normals) {
  constexpr double kShortest = 1e-6;  // of the sum of two: they are opposite
  normals.reserve(normals.size() + refined.parents.size());
  for (const Parents& parents : refined.parents) {
    const Vec<3>& first = normals[parents.vertices().front()];
    Vec<3> sum = first;
    for (const std::uint32_t vertex : parents.vertices().subspan(1)) sum += normals[vertex];
    normals.push_back(glm::length(sum) > kShortest ? glm::normalize(sum) : first);
  }
}

// What is measured on a mesh, for the mesh that is made of it by refining.
VertexGuides carry(const RefinedMesh& refined, VertexGuides guides) {
  carry_normals(refined, guides.normals);
  if (!guides.smooth_normals.empty()) carry_normals(refined, guides.smooth_normals);
  if (!guides.directions.empty()) guides.directions = refined.carry_lines(std::move(guides.directions));
  if (guides.numbers.empty()) return guides;
  guides.steering.weights = refined.carry(std::move(guides.steering.weights));
  const std::vector<float> numbers =
      refined.carry(std::vector<float>(guides.numbers.begin(), guides.numbers.end()));
  guides.numbers.assign(numbers.begin(), numbers.end());
  return guides;
}

// As many as there is memory for, with a closed mesh's two faces for each vertex, or any other share of them.
RefineOptions limited(RefineOptions options, std::uint64_t most_memory) {
  const double none = bake_memory(0.0, 0.0);
  const double vertices =
      std::max(static_cast<double>(most_memory) - none, 0.0) / (bake_memory(1.0, 2.0) - none);
  if (vertices >= static_cast<double>(options.most_vertices)) return options;
  options.most_vertices = static_cast<std::size_t>(vertices);
  options.most_faces = 2 * options.most_vertices;
  return options;
}

void require_memory(const PolygonMesh& mesh, const BakeRecipe& recipe, std::uint64_t most_memory) {
  const auto vertices = static_cast<double>(mesh.positions.size());
  const double bytes =
      bake_memory(vertices, static_cast<double>(mesh.face_count())) + vertices * smoothing_memory(recipe);
  if (bytes <= static_cast<double>(most_memory)) return;
  throw std::runtime_error(
      fmt::format("to bake {} vertices and {} faces may take {:.0f} MiB of memory, more than it may",
                  mesh.positions.size(), mesh.face_count(), std::ceil(bytes / 0x1p20)));
}

// What points alone cannot have.
void require_faces(const PolygonMesh& mesh, const BakeRecipe& recipe) {
  if (mesh.face_count() > 0) return;
  if (recipe.refine.mode != RefineRecipe::Mode::off)
    throw std::invalid_argument("refine needs faces; the mesh is of points alone");
  if (recipe.displace != 0.0 && lies_in_unknown_planes(mesh)) {
    throw std::invalid_argument(fmt::format(
        "displace is {}; it must be 0 for points that have no normals (nx, ny, nz)", recipe.displace));
  }
}

// Edges of these lengths at the vertices show frequencies up to `highest` times the principal one, or
// `finest` where that is higher.
std::vector<double> edges_that_show(const VertexNumber& frequency, double finest, double highest,
                                    std::size_t vertices) {
  constexpr double kCyclesPerEdge = 0.5;
  std::vector<double> lengths(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    lengths[i] = kCyclesPerEdge / (highest * std::max(at(frequency, i), finest));
  return lengths;
}

// Of the layers' own noises, cycles per world unit.
double finest_of_layers(const BakeRecipe& recipe, double feature_size) {
  const double finest = finest_frequency(recipe.layers, recipe.fields);
  return recipe.layer_unit == LayerUnit::world ? finest : finest / feature_size;
}

// How much longer than `targets` edges have to be for a budget of vertices.
double stretch_within(const PolygonMesh& mesh, const std::vector<double>& targets, std::uint64_t budget,
                      const RefineOptions& options) {
  const auto vertices_of = [&](double stretch) {
    std::vector<double> longer = targets;
    for (double& target : longer) target *= stretch;
    return refined_vertices(mesh, longer, options, static_cast<double>(budget));
  };
  const double most = static_cast<double>(budget);
  if (vertices_of(1.0) <= most) return 1.0;
  double low = 1.0;
  double high = 2.0;
  while (vertices_of(high) > most && high < 1e12) high *= 2.0;
  constexpr double kExact = 1.01;
  while (high > kExact * low) {
    const double middle = std::sqrt(low * high);
    (vertices_of(middle) > most ? low : high) = middle;
  }
  return high;
}

// `targets`: edges_that_show().
RefinedMesh refine_mesh(const PolygonMesh& mesh, const RefineRecipe& recipe, std::vector<double> targets,
                        std::uint64_t most_memory, Progress* progress) {
  const RefineOptions options =
      limited({.method = recipe.method, .placement = recipe.placement}, most_memory);
  if (recipe.mode == RefineRecipe::Mode::rounds) return subdivide(mesh, recipe.rounds, options, progress);
  const std::uint64_t budget =
      recipe.budget > 0 ? recipe.budget : default_vertex_budget(mesh.positions.size());
  const double stretch = stretch_within(mesh, targets, budget, options);
  for (double& target : targets) target *= stretch;
  return refine(mesh, targets, options, progress);
}

}  // namespace

bool lies_in_unknown_planes(const PolygonMesh& mesh) {
  return mesh.face_count() == 0 && normal_parts(mesh).empty();
}

BakePlan plan_bake(PolygonMesh mesh, const BakeRecipe& recipe, Progress* progress,
                   std::uint64_t most_memory) {
  recipe.validate();
  require_faces(mesh, recipe);
  require_memory(mesh, recipe, most_memory);
  BakePlan plan;
  plan.original_vertices = mesh.positions.size();
  const double diagonal = diagonal_of(mesh);
  const ParameterRange frequency = frequencies_of(recipe, diagonal);
  plan.feature_size = feature_size_of(recipe, diagonal);
  {
    const SurfaceMesh surface(mesh);
    plan.mean_edge = surface.mean_edge_length();
    plan.guides = measure_guides(mesh, surface, recipe, frequency, progress);
  }
  // The band is in proportion to the frequency.
  const double highest = surface_band(recipe.noise, 1.0, recipe.bandwidth.from).upper;
  plan.parameters = make_parameters(recipe, frequency, plan.guides.steering.weights);
  plan.mean_cycles_per_edge = mean_cycles_per_edge(mesh, plan.parameters.frequency, highest);
  const double finest = finest_of_layers(recipe, plan.feature_size);
  std::vector<double> targets =
      edges_that_show(plan.parameters.frequency, finest, highest, mesh.positions.size());
  if (plan.mean_cycles_per_edge > kHighestCyclesPerEdge) {
    const auto shown = edges_that_show(plan.parameters.frequency, 0.0, highest, mesh.positions.size());
    plan.vertices_to_show = refined_vertices(mesh, shown, {}, kMostCounted);
  }
  if (recipe.refine.mode != RefineRecipe::Mode::off) {
    RefinedMesh refined = refine_mesh(mesh, recipe.refine, std::move(targets), most_memory, progress);
    plan.guides = carry(refined, std::move(plan.guides));
    mesh = std::move(refined.mesh);
    plan.mean_edge = SurfaceMesh(mesh).mean_edge_length();
    plan.parameters = make_parameters(recipe, frequency, plan.guides.steering.weights);
    plan.mean_cycles_per_edge = mean_cycles_per_edge(mesh, plan.parameters.frequency, highest);
  }
  plan.mesh = std::move(mesh);
  plan.highest_frequency = highest * std::max({frequency.from, frequency.to, finest});
  return plan;
}

std::vector<std::string_view> keepable_names() {
  std::vector<std::string_view> names;
  for (const Keepable& keepable : keepables()) names.push_back(keepable.name);
  return names;
}

void require_keepable(const std::vector<std::string>& names, const BakeRecipe& recipe) {
  for (const std::string& name : names) {
    const Needs needs = find_keepable(name).needs;
    if (needs == Needs::steering && !recipe.steers()) {
      throw std::invalid_argument(
          fmt::format("keep is {}; there is none where no parameter is a range", name));
    }
    if (needs == Needs::directions && !has_direction(recipe.noise)) {
      throw std::invalid_argument(fmt::format("keep is {}; only oriented noise has one", name));
    }
  }
}

BakedMesh bake(const BakePlan& plan, const BakeRecipe& recipe, const std::vector<std::string>& keep,
               Progress* progress) {
  require_keepable(keep, recipe);
  BakedMesh baked;
  baked.mesh = plan.mesh;
  baked.normals = plan.guides.normals;
  BakeWishes wishes{.colors = true};
  for (const auto& [name, layer] : recipe.properties) wishes.properties.push_back(name);
  wishes.slopes = std::any_of(keep.begin(), keep.end(), [](const std::string& name) {
    return find_keepable(name).needs == Needs::slopes;
  });
  wishes.bounds_gradient = wishes.slopes;
  BakedValues values = bake_values(plan, recipe, wishes, progress);
  for (const std::string& name : keep) {
    for (VertexProperty& property : find_keepable(name).properties(plan, values))
      baked.mesh.set_property(std::move(property));
  }
  baked.moments = Moments::of(values.noise);
  baked.colors = std::move(values.colors);
  set_vertex_colors(baked.mesh, baked.colors);
  baked.mesh.set_property({"noise", ScalarType::float32, {values.noise.begin(), values.noise.end()}});
  std::vector<float>* heights = &values.noise;
  for (std::size_t i = 0; i < wishes.properties.size(); ++i) {
    std::vector<float>& numbers = values.properties[i];
    baked.mesh.set_property({wishes.properties[i], ScalarType::float32, {numbers.begin(), numbers.end()}});
    if (wishes.properties[i] == kHeightProperty) heights = &numbers;
  }
  if (recipe.displace != 0.0) {
    for (float& height : *heights) height *= static_cast<float>(recipe.displace);
    displace(baked.mesh, baked.normals, *heights);
    const SurfaceMesh surface(baked.mesh);
    baked.normals = surface.to_vertices(surface.normals());
  }
  return baked;
}

}  // namespace solidnoise
