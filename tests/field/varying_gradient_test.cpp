#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/field/varying_field.h"
#include "support/expect_gradient.h"

namespace solidnoise::varying_gradient_test {
namespace {

// A frequency that is another one beyond x = 0, and the same on either side.
class Halves final : public Field<3> {
 public:
  std::unique_ptr<FieldBlock<3>> block(const Box<3>&) const override { return nullptr; }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      samples.values[i] = points.positions[i].x < 0 ? 1.5f : 4.0f;
  }
};

TEST(VaryingField, HasTheGradientOfItsValuesInSpaceWhereParametersAreConstant) {
  const VaryingParameter frequency{std::make_shared<Halves>(), 1.5, 4.0};
  RandomStream random(7);
  std::vector<Vec<3>> positions;
  Slopes<3> slopes;
  while (positions.size() < 100) {
    const Vec<3> at(random.next_unit(), random.next_unit(), random.next_unit());
    if (std::abs(at.x - 0.5) < 0.05) continue;  // differences reach a fiftieth of 1 / F
    positions.push_back(4.0 * at - Vec<3>(2.0));
    slopes.frequency.push_back(2.0 * (at.x < 0.5 ? 1.5 : 4.0));  // of the second octave
    slopes.magnitude.push_back(1.0);
  }
  for (const Vec<3>& axis : {Vec<3>(1.0, 0.0, 0.0), Vec<3>(0.0, 1.0, 0.0), Vec<3>(0.0, 0.0, 1.0)}) {
    slopes.directions.emplace_back(positions.size(), axis);
  }
  for (const int dims : {3, 4}) {
    SCOPED_TRACE(dims);
    const NoiseView view{.dims = dims, .time = 0.3, .offset = {0.1, 0.2, 0.3}};
    const NoiseRecipe recipe{GaborNoiseOptions{.seed = 3}, {.octaves = 2}};
    const FieldPtr field =
        make_varying_field(recipe, view, {.frequency = frequency, .bandwidth = {}, .direction = {}});
    ASSERT_TRUE(field->has_gradient());
    expect_gradient<3>(positions, slopes, [&](const Points<3>& points, const Samples<3>& samples) {
      field->evaluate(points, samples);
    });
  }
}

}  // namespace
}  // namespace solidnoise::varying_gradient_test
