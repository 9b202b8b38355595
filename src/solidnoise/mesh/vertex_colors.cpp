#include "solidnoise/mesh/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/image/color.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/vertex_parameters.h"

namespace solidnoise {

void set_vertex_colors(PolygonMesh& mesh, std::span<const Color> colors) {
  constexpr double kBrightest = 255.0;
  for (std::size_t channel = 0; channel < kColorNames.size(); ++channel) {
    VertexProperty property{std::string(kColorNames[channel]), ScalarType::uint8,
                            std::vector<double>(colors.size(), kBrightest)};
    if (channel < 3) {
      tbb::parallel_for(std::size_t{0}, colors.size(), [&](std::size_t i) {
        const double encoded = srgb_from_linear(colors[i][static_cast<int>(channel)]);
        property.values[i] = std::round(kBrightest * std::clamp(encoded, 0.0, 1.0));
      });
    }
    mesh.set_property(std::move(property));
  }
}

void CurvatureRecipe::validate() const {
  by.validate();
  CurvatureOptions{.rounds = smooth, .radius = smooth_radius}.validate();
  parse_color_ramp(ramp);
}

ShownCurvature show_curvature(const PolygonMesh& mesh, const CurvatureRecipe& recipe) {
  recipe.validate();
  const SurfaceMesh surface(mesh);
  const Curvature curvature =
      measure_curvature(surface, {.rounds = recipe.smooth, .radius = recipe.smooth_radius});
  ShownCurvature shown;
  shown.mesh = mesh;
  shown.normals = surface.to_vertices(surface.normals());
  const std::size_t count = mesh.positions.size();
  std::vector<double> mean(count);
  std::vector<double> gaussian(count);
  for (std::size_t i = 0; i < count; ++i) {
    mean[i] = curvature.mean(i);
    gaussian[i] = curvature.gaussian(i);
  }
  shown.mesh.set_property({"mean_curvature", ScalarType::float32, std::move(mean)});
  shown.mesh.set_property({"gaussian_curvature", ScalarType::float32, std::move(gaussian)});
  shown.mesh.set_property({"k1", ScalarType::float32, curvature.k1});
  shown.mesh.set_property({"k2", ScalarType::float32, curvature.k2});

  shown.steering =
      make_weights(steering_numbers(mesh, curvature, recipe.by, recipe.up), recipe.by, vertex_areas(surface));
  const ColorRamp ramp = parse_color_ramp(recipe.ramp);
  for (const float weight : shown.steering.weights) shown.colors.push_back(ramp.linear(weight));
  set_vertex_colors(shown.mesh, shown.colors);
  return shown;
}

}  // namespace solidnoise
