#include "solidnoise/mesh/bake_cost.h"

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

}  // namespace

// Measured on meshes of half a million to thirteen million vertices, with two faces for each: 285 to 298
// bytes for a vertex and its faces, 335 with directions, ranges and what --keep names, 560 with meshnoise's
// preview; 76 for a face where a million share three vertices.
double bake_memory(double vertices, double faces) {
  constexpr double kProgram = 18.0 * 0x1p20;
  constexpr double kVertex = 190.0;
  constexpr double kFace = 80.0;
  return kProgram + kVertex * vertices + kFace * faces;
}

// Of the impulses within reach of the vertices that are evaluated together, for each that a vertex is reached
// by. Measured with 2000 and 5000 of them.
double impulse_memory(SurfaceNoiseKind kind, double impulses) {
  const double each = kind == SurfaceNoiseKind::oriented  ? 15.0
                      : kind == SurfaceNoiseKind::surface ? 7.0
                                                          : 3.0;
  return 1024.0 * each * impulses;
}

// Measured with each kind of noise: colours and the file, and the noise's impulses at a vertex. Noise without
// impulses takes the time of twenty.
BakeCost bake_cost(const BakePlan& plan, const BakeRecipe& recipe) {
  constexpr double kSecondsPerVertex = 1.3e-6;
  constexpr double kSecondsPerImpulse = 3.5e-9;
  constexpr double kSecondsPerTangentImpulse = 9e-9;
  constexpr double kLeastImpulses = 20.0;
  const bool in_tangent_plane =
      recipe.noise.kind == SurfaceNoiseKind::surface || recipe.noise.kind == SurfaceNoiseKind::oriented;
  const double vertices = static_cast<double>(plan.mesh.positions.size());
  const double frequency = plan.parameters.frequency.constant;
  const bool is_graded = plan.parameters.frequency.varies() && !has_bandwidth(recipe.noise.kind);
  const double impulses =
      (is_graded ? 2.0 : 1.0) *
      (kLeastImpulses + impulses_at_point(recipe.noise, {frequency, plan.parameters.bandwidth.constant, {}}));
  const double channels = recipe.has_exemplar_colors()
                              ? static_cast<double>(recipe.noise.exemplar.channels.size())
                              : 1.0 + count_layers(recipe.layers) + count_properties(recipe);
  return {
      vertices * (kSecondsPerVertex +
                  channels * impulses * (in_tangent_plane ? kSecondsPerTangentImpulse : kSecondsPerImpulse)),
      bake_memory(vertices, static_cast<double>(plan.mesh.face_count())) +
          impulse_memory(recipe.noise.kind, impulses)};
}

}  // namespace solidnoise
