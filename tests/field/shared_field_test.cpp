#include "solidnoise/field/shared_field.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "support/wave_field.h"

namespace solidnoise::shared_field_test {
namespace {

// Counts how often it is asked.
class CountedField final : public PointwiseField {
 public:
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    ++asked;
    wave.evaluate(points, samples);
  }

  mutable int asked = 0;
  WaveField wave{Vec<3>(0.3, 0.5, 0.7)};
};

TEST(SharedField, EvaluatesPointsOnceForAllThatUseIt) {
  const auto counted = std::make_shared<CountedField>();
  const FieldPtr shared = share(counted);
  std::vector<Vec<3>> positions{Vec<3>(0.1, 0.2, 0.3), Vec<3>(-4.0, 5.0, 6.0)};
  std::vector<Vec<3>> normals(2, Vec<3>(0.0, 0.0, 1.0));
  std::vector<float> values(2);
  const auto expect = [&](int asked) {
    shared->evaluate({positions, normals}, {values, {}});
    EXPECT_EQ(counted->asked, asked);
    for (std::size_t i = 0; i < positions.size(); ++i) EXPECT_EQ(values[i], counted->wave.at(positions[i]));
  };
  expect(1);
  expect(1);
  positions[1].x = 4.0;
  expect(2);
  normals[0].x = 1.0;
  expect(3);
  positions.pop_back();
  normals.pop_back();
  values.pop_back();
  expect(4);
}

}  // namespace
}  // namespace solidnoise::shared_field_test
