#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise::moved_noise_test {
namespace {

std::vector<float> values_of(const Noise<3>& noise, const Vec<3>& origin) {
  Lattice<3> lattice;
  lattice.origin = origin;
  lattice.step = Vec<3>(0.125);
  lattice.count = {9, 10, 11};
  std::vector<float> values(lattice.size());
  noise.evaluate(lattice, {.values = values});
  return values;
}

// Offset and origins are exact in binary: the values are the same to the last bit.
TEST(MovedNoise, IsTheSameNoiseElsewhere) {
  for (const NoiseRecipe& recipe : {NoiseRecipe{GaborNoiseOptions{.frequency = 3.0}, {.octaves = 2}},
                                    NoiseRecipe{GradientNoiseOptions{.frequency = 3.0}, {}}}) {
    const std::shared_ptr<const Noise<3>> noise = make_noise<3>(recipe);
    const Vec<3> offset(1.5, -20.25, 0.5);
    const auto moved = move_noise<3>(noise, offset);
    const Vec<3> at(0.25, 0.5, -3.0);
    EXPECT_EQ(values_of(*moved, at + offset), values_of(*noise, at));
    EXPECT_NE(values_of(*moved, at), values_of(*noise, at));

    const Vec<3> moved_at = at + offset;
    const Points<3> here{{&at, 1}};
    const Points<3> there{{&moved_at, 1}};
    float expected = 0.0f;
    float value = 1.0f;
    noise->evaluate(here, {.values = std::span(&expected, 1)});
    moved->evaluate(there, {.values = std::span(&value, 1)});
    EXPECT_EQ(value, expected);
    EXPECT_EQ(moved->variance(), noise->variance());
    EXPECT_EQ(moved->power_spectrum({3.0, 0.0, 0.0}), noise->power_spectrum({3.0, 0.0, 0.0}));
  }
}

TEST(MovedNoise, RefusesAnOffsetThatIsNotFinite) {
  const std::shared_ptr<const Noise<3>> noise = make_noise<3>({GaborNoiseOptions{}, {}});
  EXPECT_THROW(move_noise<3>(noise, {0.0, 1.0 / 0.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::moved_noise_test
