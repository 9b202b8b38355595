#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/mesh/surface_field.h"
#include "solidnoise/noise/point/point_parameters.h"
#include "support/expect_gradient.h"
#include "support/spectra.h"

namespace solidnoise::surface_gradient_test {
namespace {

// The same direction everywhere.
class Constant final : public PointwiseField {
 public:
  int channels() const override { return 3; }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < samples.values.size(); ++i)
      samples.values[i] = i < points.size() ? 1.0f : 0.5f;
  }
};

TEST(SurfaceField, HasTheGradientOfItsValuesAlongTheSurface) {
  RandomStream random(5);
  std::vector<Vec<3>> positions, normals;
  Slopes<3> slopes;
  slopes.directions.resize(2);
  for (int i = 0; i < 60; ++i) {
    positions.emplace_back(random.next_unit(), random.next_unit(), random.next_unit());
    normals.push_back(glm::normalize(Vec<3>(random.next_unit(), random.next_unit(), -0.5)));
    slopes.directions[0].push_back(unit_tangent({0.3, 0.5, 0.8}, normals.back()));
    slopes.directions[1].push_back(glm::cross(normals.back(), slopes.directions[0].back()));
    slopes.frequency.push_back(8.0);  // of the second octave
    slopes.magnitude.push_back(1.0);
  }
  const SurfaceKernel kernel{
      .frequency = 4.0,
      .fields = {.frequency = {}, .bandwidth = {}, .direction = std::make_shared<Constant>()}};
  for (const SurfaceNoiseKind kind : {SurfaceNoiseKind::surface, SurfaceNoiseKind::oriented,
                                      SurfaceNoiseKind::kensler, SurfaceNoiseKind::spectrum}) {
    SCOPED_TRACE(static_cast<int>(kind));
    SurfaceNoiseRecipe recipe;
    recipe.kind = kind;
    recipe.fractal.octaves = 2;
    if (kind == SurfaceNoiseKind::spectrum) recipe.exemplar = some_spectrum(2).model;
    const FieldPtr field = make_surface_field(recipe, kernel);
    ASSERT_TRUE(field->has_gradient());
    expect_gradient<3>(positions, slopes, [&](const Points<3>& points, const Samples<3>& samples) {
      field->evaluate({points.positions, normals}, samples);
    });
  }
}

}  // namespace
}  // namespace solidnoise::surface_gradient_test
