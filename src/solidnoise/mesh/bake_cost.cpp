#include "solidnoise/mesh/bake_cost.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>

#include "solidnoise/mesh/surface_field.h"

namespace solidnoise {
namespace {

// Layers, and those that they are made of.
double count_layers(const std::vector<Layer>& layers) {
  double count = 0.0;
  for (const Layer& layer : layers) count += 1.0 + count_layers(layer.layers);
  return count;
}

double count_properties(const BakeRecipe& recipe) {
  double count = 0.0;
  for (const auto& [name, layer] : recipe.properties) count += count_layers({layer});
  return count;
}

// The faces' shortest edges over all of them: 1 where faces are regular, little of slivers.
double shortest_edges(const PolygonMesh& mesh) {
  constexpr double kRegular = 0.8;  // of the triangles of scans
  double shortest = 0.0;
  double all = 0.0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    double least = std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const double length =
          glm::distance(mesh.positions[face[i]], mesh.positions[face[(i + 1) % face.size()]]);
      least = std::min(least, length);
      sum += length;
    }
    shortest += least;
    all += sum / static_cast<double>(face.size());
  }
  return all > 0.0 ? std::min(shortest / (kRegular * all), 1.0) : 1.0;
}

// Octaves whose impulses are made anew for each vertex: all of those whose kernels reach less far than from
// a vertex to the next, few of the others.
double count_lone_octaves(const BakePlan& plan, const FractalOptions& fractal) {
  constexpr double kReach = 5.0;  // cycles of the highest frequency, where half are made anew
  const double finest = plan.mean_cycles_per_edge * shortest_edges(plan.mesh);
  double count = 0.0;
  for (int k = 0; k < fractal.octaves; ++k) {
    const double cycles = finest / fractal.frequency_ratio(k);
    count += cycles * cycles / (cycles * cycles + kReach * kReach);
  }
  return count;
}

}  // namespace

// Measured on meshes of half a million to thirteen million vertices, with two faces for each: 285 to 298
// bytes for a vertex and its faces, 335 with directions, ranges and what --keep names, 560 with meshnoise's
// preview; 76 for a face where a million share three vertices.
double bake_memory(double vertices, double faces) {
  constexpr double kProgram = 22.0 * 0x1p20;
  constexpr double kVertex = 190.0;
  constexpr double kFace = 80.0;
  return kProgram + kVertex * vertices + kFace * faces;
}

namespace {

// What is smoothed over a mesh: normals, directions, and how it bends.
struct Smoothings {
  bool normals = false;
  bool directions = false;
  CurvatureNeeded curvature = CurvatureNeeded::none;
};
Smoothings smoothings_of(const BakeRecipe& recipe) {
  const bool smooths = recipe.smooth_radius.value_or(1.0) > 0.0;
  return {smooths && has_plane(recipe.noise), smooths && recipe.noise.kind == SurfaceNoiseKind::oriented,
          curvature_needed(recipe)};
}

// Of one core for each vertex, the fit of the curvature included. Of a million vertices and radii of 10 to 90
// edges.
double smoothing_seconds(const BakeRecipe& recipe) {
  constexpr double kNormals = 3e-6;
  constexpr double kDirections = 4.5e-6;
  constexpr double kMean = 3.5e-6;
  constexpr double kCurvature = 6.5e-6;
  const auto [normals, directions, curvature] = smoothings_of(recipe);
  double seconds = (normals ? kNormals : 0.0) + (directions ? kDirections : 0.0);
  if (curvature == CurvatureNeeded::mean) seconds += kMean;
  if (curvature == CurvatureNeeded::all) seconds += kCurvature;
  return seconds;
}

}  // namespace

// Measured on tori of a quarter of a million and of a million vertices; what smooths is kept from one to the
// next in part.
double smoothing_memory(const BakeRecipe& recipe) {
  const auto [normals, directions, curvature] = smoothings_of(recipe);
  const bool bends = curvature != CurvatureNeeded::none;
  return (normals || directions || bends ? 300.0 : 0.0) + (directions ? 90.0 : 0.0) + (bends ? 80.0 : 0.0);
}

// Of the impulses within reach of the vertices that are evaluated together, for each that a vertex is reached
// by. Measured with 2000 and 5000 of them.
double impulse_memory(SurfaceNoiseKind kind, double impulses) {
  const double each = kind == SurfaceNoiseKind::oriented  ? 16.0
                      : kind == SurfaceNoiseKind::surface ? 7.0
                                                          : 3.0;
  return 1024.0 * each * impulses;
}

// Measured with each kind of noise: what a program takes, colours and the file, what smooths how the surface
// bends, and the noise's impulses at a vertex. Noise without impulses takes the time of twenty.
Cost bake_cost(const BakePlan& plan, const BakeRecipe& recipe) {
  constexpr double kProgramSeconds = 0.03;
  constexpr double kSecondsPerVertex = 1.3e-6;
  constexpr double kSecondsPerImpulse = 3.5e-9;
  constexpr double kSecondsPerTangentImpulse = 9e-9;
  constexpr double kSecondsPerLoneOctave = 14e-6;
  constexpr double kFewestImpulses = 20.0;
  const bool in_tangent_plane =
      recipe.noise.kind == SurfaceNoiseKind::surface || recipe.noise.kind == SurfaceNoiseKind::oriented;
  const double vertices = static_cast<double>(plan.mesh.positions.size());
  const double frequency = plan.parameters.frequency.constant;
  const bool is_graded = plan.parameters.frequency.varies() && !has_bandwidth(recipe.noise.kind);
  const double reached = impulses_at_point(recipe.noise, {frequency, plan.parameters.bandwidth.constant, {}});
  const double impulses = (is_graded ? 2.0 : 1.0) * (kFewestImpulses + reached);
  const double noises =
      recipe.layers.empty()
          ? 1.0
          : static_cast<double>(
                noises_of(recipe.layers, noise_of_layers(recipe.noise), recipe.fields).size());
  const double making =
      reached > 0.0 ? kSecondsPerLoneOctave * noises * count_lone_octaves(plan, recipe.noise.fractal) : 0.0;
  const double channels = recipe.has_exemplar_colors()
                              ? static_cast<double>(recipe.noise.exemplar.channels.size())
                              : 1.0 + count_layers(recipe.layers) + count_properties(recipe);
  const double of_impulse = in_tangent_plane ? kSecondsPerTangentImpulse : kSecondsPerImpulse;
  const double original = static_cast<double>(plan.original_vertices);
  const double faces = static_cast<double>(plan.mesh.face_count());
  const double planning =
      bake_memory(original, std::min(faces, 2.0 * original)) + original * smoothing_memory(recipe);
  return {kProgramSeconds + original * smoothing_seconds(recipe) +
              vertices * (kSecondsPerVertex + channels * impulses * of_impulse + making),
          std::max(planning, bake_memory(vertices, faces)) + impulse_memory(recipe.noise.kind, impulses)};
}

// Measured at 256 to 1024 pixels.
Cost with_preview(const Cost& bake, int side) {
  constexpr double kSecondsPerPixel = 7e-6;
  constexpr double kBytesPerPixel = 40.0;
  const double pixels = static_cast<double>(side) * side;
  return {bake.seconds + 0.3 + kSecondsPerPixel * pixels,
          kPreviewMemory * bake.bytes + kImageMemory + kBytesPerPixel * pixels};
}

}  // namespace solidnoise
